// SPDX-License-Identifier: MIT
#include <slant/sets/interval.hpp>
#include <slant/sets/power.hpp>

#include <doctest/doctest.h>

#include <limits>

namespace symmetric_interval_test {

TEST_CASE_TEMPLATE("symmetric_interval: an interval with one parameter", S, float, double,
                   long double) {
  using vec = Eigen::Matrix<S, 1, 1>;
  slant::symmetric_interval<S> const set(S(2));
  CHECK(set.lower() == S(-2));
  CHECK(set.radius() == S(2));
  CHECK(set.project(vec(S(-3)))(0) == S(-2));
  CHECK(set.project(vec(S(1)))(0) == S(1));
  CHECK(set.with(S(0)).state(vec(S(0))) == slant::block_state::fixed);
  CHECK(set.with(S(0)).slant(vec(S(0)))(0) == S(0));
  CHECK(set.with(std::numeric_limits<S>::infinity()).contains(vec(S(1000))));
  CHECK_THROWS_WITH_AS(static_cast<void>(set.with(S(-1))), "radius: got -1, expected a number >= 0",
                       slant::bad_input);
  CHECK_THROWS_AS(static_cast<void>(set.with(std::numeric_limits<S>::quiet_NaN())),
                  slant::bad_input);
}

TEST_CASE("symmetric_interval: in a power it has one parameter per block") {
  Eigen::VectorXd const g = Eigen::Vector3d(1, 2, 0);
  auto set = slant::power(slant::symmetric_interval<>{}, g);
  Eigen::VectorXd const x = Eigen::Vector3d(-5, 5, 5);
  CHECK(slant::project(set, x) == Eigen::Vector3d(-1, 2, 0));
  set.update(Eigen::VectorXd(3 * g));
  CHECK(slant::project(set, x) == Eigen::Vector3d(-3, 5, 0));
}

}  // namespace symmetric_interval_test
