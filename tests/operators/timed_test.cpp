// SPDX-License-Identifier: MIT
#include <slant/operators/diagonal.hpp>
#include <slant/operators/timed.hpp>
#include <slant/testing/laws.hpp>

#include <chrono>
#include <support/testing.hpp>
#include "operators/dense_oracle.hpp"

namespace timed_test {

/// The identity, taking at least two milliseconds.
struct slow_identity {
  [[nodiscard]] slant::index rows() const { return 2; }
  [[nodiscard]] slant::index cols() const { return 2; }
  void apply(VectorXd const& x, VectorXd& y) const {
    auto const start = std::chrono::steady_clock::now();
    while (std::chrono::steady_clock::now() - start < std::chrono::milliseconds(2)) {
    }
    y = x;
  }
};

TEST_CASE("time adds up, over copies, until it is reset") {
  auto const a = slant::timed(slow_identity{});
  CHECK(a.seconds() == 0);
  VectorXd y(2);
  slant::apply(a, VectorXd(VectorXd::Ones(2)), y);
  CHECK(a.seconds() >= 2e-3);
  auto const copy = a;
  slant::apply(copy, VectorXd(VectorXd::Ones(2)), y);
  CHECK(a.seconds() >= 4e-3);
  a.reset_seconds();
  CHECK(copy.seconds() == 0);
}

TEST_CASE("laws and capabilities are those of the operator inside") {
  auto const d = slant::diagonal<slant::positive_definite>(VectorXd(VectorXd::LinSpaced(3, 1, 2)));
  auto const a = slant::timed(d);
  static_assert(slant::spd_operator<decltype(a), VectorXd>);
  static_assert(slant::has_inverse<decltype(a), VectorXd>);
  static_assert(!slant::has_accumulate<slant::timed_operator<slow_identity>, VectorXd>);
  slant::testing::check_operator_laws(a);
}

}  // namespace timed_test
