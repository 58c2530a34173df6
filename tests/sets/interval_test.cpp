// SPDX-License-Identifier: MIT
#include <slant/sets/sets.hpp>

#include <support/testing.hpp>
#include "oracle/precise.hpp"

namespace interval_test {

template <class S>
using vec = Eigen::Matrix<S, 1, 1>;

template <class S>
vec<S> at(S const& value) {
  return vec<S>::Constant(value);
}

TEST_CASE_TEMPLATE("half line: known answers", S, float, oracle::float_50) {
  slant::half_line<S> const positive;
  CHECK(positive.lower() == S(0));
  CHECK(positive.project(at(S(-2)))(0) == S(0));
  CHECK(positive.project(at(S(3)))(0) == S(3));
  auto const shifted = positive.with(S(-1.5));
  CHECK(shifted.project(at(S(-2)))(0) == S(-1.5));
  CHECK(shifted.step_to_boundary(at(S(0.5)), at(S(-4))) == S(0.5));
  CHECK(shifted.step_to_boundary(at(S(0.5)), at(S(4))) == std::numeric_limits<S>::infinity());
  CHECK(shifted.step_to_boundary(at(S(0.5)), at(S(0))) == std::numeric_limits<S>::infinity());
  CHECK(shifted.support(at(S(-2))) == S(3));
  CHECK(shifted.support(at(S(0))) == S(0));
  CHECK(shifted.support(at(S(2))) == std::numeric_limits<S>::infinity());
  CHECK(shifted.inequality(at(S(2)))(0) == S(-3.5));
}

TEST_CASE("half line: membership and state know a band of a few ulp, none at 0") {
  slant::half_line<double> const set(3.0);
  double const ε = std::numeric_limits<double>::epsilon();
  CHECK(set.contains(at(3.0 * (1 - 4 * ε))));
  CHECK_FALSE(set.contains(at(3.0 * (1 - 40 * ε))));
  CHECK(set.state(at(3.0)) == slant::block_state::fixed);
  CHECK(set.state(at(3.0 * (1 + 4 * ε))) == slant::block_state::fixed);
  CHECK(set.state(at(3.0 * (1 + 40 * ε))) == slant::block_state::free);
  slant::half_line<double> const positive;
  CHECK(positive.contains(at(-0.0)));
  CHECK_FALSE(positive.contains(at(-1e-300)));
  CHECK(positive.state(at(0.0)) == slant::block_state::fixed);
  CHECK(positive.state(at(1e-300)) == slant::block_state::free);
}

TEST_CASE("half line: slanting function [K (49)]") {
  slant::half_line<double> const set(2.0);
  CHECK(set.slant(at(2.0))(0, 0) == 1.0);
  CHECK(set.slant(at(1.0))(0, 0) == 0.0);
  CHECK(set.slant(at(7.0))(0, 0) == 1.0);
}

TEST_CASE("half line: steps start on the bound where rounding left them below") {
  slant::half_line<double> const set(3.0);
  double const below = std::nextafter(3.0, 0.0);
  CHECK(set.step_to_boundary(at(below), at(-1.0)) == 0.0);
  CHECK(set.step_to_boundary(at(below), at(1.0)) == infinity);
  CHECK(slant::half_line<double>(-1e308).step_to_boundary(at(1.5e308), at(-1e308)) ==
        doctest::Approx(2.5));
  CHECK(slant::half_line<double>(-infinity).step_to_boundary(at(1.0), at(-1.0)) == infinity);
}

TEST_CASE("half line: an infinite bound") {
  slant::half_line<double> const line(-infinity);
  CHECK(line.project(at(-1e308))(0) == -1e308);
  CHECK(line.contains(at(-1e308)));
  CHECK(line.state(at(-1e308)) == slant::block_state::free);
  CHECK(line.support(at(-1.0)) == infinity);
  CHECK(line.support(at(0.0)) == 0.0);
}

TEST_CASE_TEMPLATE("interval: known answers", S, float, oracle::float_50) {
  slant::interval<S> const unit;
  CHECK(unit.lower() == S(-1));
  CHECK(unit.upper() == S(1));
  auto const set = unit.with(S(-2), S(6));
  CHECK(set.project(at(S(-3)))(0) == S(-2));
  CHECK(set.project(at(S(0.5)))(0) == S(0.5));
  CHECK(set.project(at(S(9)))(0) == S(6));
  CHECK(set.step_to_boundary(at(S(2)), at(S(-8))) == S(0.5));
  CHECK(set.step_to_boundary(at(S(2)), at(S(2))) == S(2));
  CHECK(set.step_to_boundary(at(S(2)), at(S(0))) == std::numeric_limits<S>::infinity());
  CHECK(set.support(at(S(3))) == S(18));
  CHECK(set.support(at(S(-3))) == S(6));
  CHECK(set.inequality(at(S(1)))(0) == S(-3));
  CHECK(set.inequality(at(S(1)))(1) == S(-5));
}

TEST_CASE("interval: membership and state know a band of a few ulp of the bound") {
  slant::interval<double> const set(0.0, 3.0);
  double const ε = std::numeric_limits<double>::epsilon();
  CHECK(set.contains(at(3.0 * (1 + 4 * ε))));
  CHECK_FALSE(set.contains(at(3.0 * (1 + 40 * ε))));
  CHECK(set.state(at(3.0 * (1 - 4 * ε))) == slant::block_state::fixed);
  CHECK(set.state(at(3.0 * (1 - 40 * ε))) == slant::block_state::free);
  CHECK(set.state(at(0.0)) == slant::block_state::fixed);
  CHECK(set.state(at(1e-300)) == slant::block_state::free);
  CHECK_FALSE(set.contains(at(-1e-300)));
  slant::interval<double> const single(2.0, 2.0);
  CHECK(single.state(at(2.0)) == slant::block_state::fixed);
  CHECK(single.project(at(7.0))(0) == 2.0);
}

TEST_CASE("interval: slanting function") {
  slant::interval<double> const set(-2.0, 5.0);
  CHECK(set.slant(at(-2.0))(0, 0) == 1.0);
  CHECK(set.slant(at(5.0))(0, 0) == 1.0);
  CHECK(slant::interval<double>(1.0, 1.0).slant(at(1.0))(0, 0) == 0.0);
  CHECK(set.slant(at(-5.0))(0, 0) == 0.0);
  CHECK(set.slant(at(4.9))(0, 0) == 1.0);
  CHECK(set.slant(at(7.0))(0, 0) == 0.0);
}

TEST_CASE("interval: steps at, beyond and far from the bounds") {
  slant::interval<double> const set(1.0, 3.0);
  double const above = std::nextafter(3.0, 4.0);
  CHECK(set.step_to_boundary(at(above), at(1.0)) == 0.0);
  CHECK(set.step_to_boundary(at(above), at(-1.0)) == doctest::Approx(2.0));
  CHECK(set.step_to_boundary(at(1.0), at(-1e-300)) == 0.0);
  slant::interval<double> const huge(-1.5e308, 1.5e308);
  CHECK(huge.step_to_boundary(at(-1e308), at(1e308)) == doctest::Approx(2.5));
}

TEST_CASE("interval: infinite ends") {
  slant::interval<double> const line(-infinity, infinity);
  CHECK(line.project(at(-1e308))(0) == -1e308);
  CHECK(line.state(at(1e308)) == slant::block_state::free);
  CHECK(line.slant(at(1e308))(0, 0) == 1.0);
  CHECK(line.step_to_boundary(at(0.0), at(1.0)) == infinity);
  CHECK(line.support(at(1.0)) == infinity);
  CHECK(line.support(at(-1.0)) == infinity);
  CHECK(line.support(at(0.0)) == 0.0);
}

TEST_CASE_TEMPLATE("symmetric_interval: an interval with one parameter", S, float, long double) {
  using vec = Eigen::Matrix<S, 1, 1>;
  slant::symmetric_interval<S> const set(S(2));
  CHECK(set.lower() == S(-2));
  CHECK(set.radius() == S(2));
  CHECK(set.project(vec(S(-3)))(0) == S(-2));
  CHECK(set.project(vec(S(1)))(0) == S(1));
  CHECK(set.with(S(0)).state(vec(S(0))) == slant::block_state::fixed);
  CHECK(set.with(S(0)).slant(vec(S(0)))(0) == S(0));
  CHECK(set.with(std::numeric_limits<S>::infinity()).contains(vec(S(1000))));
  CHECK(SLANT_COMPLAINT(set.with(S(-1))) == "radius: got -1, expected a number >= 0");
  CHECK_THROWS_AS(static_cast<void>(set.with(std::numeric_limits<S>::quiet_NaN())),
                  slant::bad_input);
}

}  // namespace interval_test
