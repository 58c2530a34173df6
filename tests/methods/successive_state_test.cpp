// SPDX-License-Identifier: MIT
#include <slant/methods/successive_approximations.hpp>

#include <doctest/doctest.h>

#include <Eigen/Core>

#include <string>

namespace successive_state_test {

struct inner_state {};
using state = slant::successive_state<inner_state, Eigen::VectorXd>;

TEST_CASE("what a status means here; where the inner method is to blame, its own") {
  state s{};
  CHECK(s.status == slant::status::running);
  s.status = slant::status::converged;
  CHECK(s.reason() == "x solves the problem that belongs to it");
  s.status = slant::status::stalled;
  CHECK(s.reason() == "the fixed point iteration gets no nearer");
  s.status = slant::status::unbounded;
  for (auto const inner : {slant::status::unbounded, slant::status::breakdown}) {
    s.inner_status = inner;
    CHECK(s.reason() == "the inner method reports: " + std::string(slant::to_string(inner)));
  }
}

}  // namespace successive_state_test
