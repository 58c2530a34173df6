// SPDX-License-Identifier: MIT
#include <slant/sets/point.hpp>

#include "oracle/set_checks.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

namespace point_test {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double quiet_nan = std::numeric_limits<double>::quiet_NaN();

TEST_CASE_TEMPLATE("point: known answers", S, float, double, long double, oracle::float_50) {
  using vec = Eigen::Matrix<S, 2, 1>;
  slant::point<2, S> const origin;
  vec const x(S(1), S(-2)), p(S(3), S(0.5)), none(S(0), S(0));
  CHECK(origin.project(x) == none);
  auto const set = origin.with(p);
  CHECK(set.position() == p);
  CHECK(set.project(x) == p);
  CHECK(set.contains(p));
  CHECK_FALSE(set.contains(x));
  CHECK(set.state(p) == slant::block_state::fixed);
  CHECK(set.slant(p) == Eigen::Matrix<S, 2, 2>::Zero());
  CHECK(set.step_to_boundary(p, x) == S(0));
  CHECK(set.step_to_boundary(p, none) == std::numeric_limits<S>::infinity());
  CHECK(set.support(x) == S(2));
}

TEST_CASE("point: membership is relative to the size of the point") {
  double const ε = std::numeric_limits<double>::epsilon();
  for (double scale : {1e-300, 1e-150, 1.0, 1e150, 1e300}) {
    Eigen::Vector2d const p(3 * scale, -4 * scale), off(scale, scale);
    slant::point<2> const set(p);
    CHECK(set.contains(p + 4 * ε * off));
    CHECK_FALSE(set.contains(p + 400 * ε * off));
  }
  slant::point<2> const origin;
  CHECK(origin.contains(Eigen::Vector2d(0, 0)));
  CHECK_FALSE(origin.contains(Eigen::Vector2d(0, 5e-324)));
}

TEST_CASE("point: NaN stays NaN") {
  slant::point<2> const origin;
  Eigen::Vector2d const bad(1, quiet_nan), good(1, 2);
  CHECK(origin.project(bad).array().isNaN().all());
  CHECK(origin.slant(bad).array().isNaN().all());
  CHECK(std::isnan(origin.step_to_boundary(bad, good)));
  CHECK(std::isnan(origin.step_to_boundary(good, bad)));
  CHECK(std::isnan(origin.support(bad)));
  CHECK_FALSE(origin.contains(bad));
}

TEST_CASE("point: bad input is named with its position") {
  using slant::bad_input;
  auto const made = [](double a, double b) {
    return oracle::complaint<bad_input>([=] { return slant::point<2>(Eigen::Vector2d(a, b)); });
  };
  CHECK(made(1.0, quiet_nan) == "p(1): got nan, expected a finite number");
  CHECK(made(-inf, 0.0) == "p(0): got -inf, expected a finite number");
  CHECK(made(1.0, 2.0).empty());
}

}  // namespace point_test
