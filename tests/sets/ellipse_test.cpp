// SPDX-License-Identifier: MIT
#include <slant/sets/ball.hpp>
#include <slant/sets/ellipse.hpp>

#include "oracle/projection_errors.hpp"
#include "oracle/set_checks.hpp"
#include "oracle/step_errors.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <support/effort.hpp>
#include <vector>

namespace ellipse_test {

using oracle::float_50;
using slant::block_state;
using slant::ellipse;
using vec2 = Eigen::Vector2d;

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double quiet_nan = std::numeric_limits<double>::quiet_NaN();
constexpr double ε = std::numeric_limits<double>::epsilon();

TEST_CASE_TEMPLATE("ellipse: known answers", S, float, double, long double, float_50) {
  using vec = Eigen::Matrix<S, 2, 1>;
  ellipse<S> const unit;
  CHECK(unit.a() == S(1));
  auto const set = unit.with(S(4), S(2));
  CHECK(set.project(vec(S(1), S(1))) == vec(S(1), S(1)));
  CHECK(set.project(vec(S(9), S(0))) == vec(S(4), S(0)));
  CHECK(set.project(vec(S(0), S(-9))) == vec(S(0), S(-2)));
  // The foot (4·0.6, 2·0.8) has the normal (0.6/4, 0.8/2): from (2.4, 1.6) go 8 normals out.
  auto const p = set.project(vec(S(36) / S(10), S(48) / S(10)));
  CHECK(static_cast<double>(abs(p(0) - S(24) / S(10))) <=
        4 * static_cast<double>(std::numeric_limits<S>::epsilon()));
  CHECK(static_cast<double>(abs(p(1) - S(16) / S(10))) <=
        4 * static_cast<double>(std::numeric_limits<S>::epsilon()));
  CHECK(set.support(vec(S(3), S(8))) == S(20));
  CHECK(set.inequality(vec(S(2), S(1)))(0) == S(-0.5));
  CHECK(set.step_to_boundary(vec(S(0), S(1)), vec(S(0), S(-2))) == S(1.5));
  CHECK(set.step_to_boundary(vec(S(-4), S(0)), vec(S(1), S(0))) == S(8));
  CHECK(set.step_to_boundary(vec(S(4), S(0)), vec(S(1), S(0))) == S(0));
}

TEST_CASE("ellipse: random and adversarial points within 2 ulp of the 50-digit projection") {
  auto const check = [](auto const& errors) {
    CAPTURE(errors.worst.first);
    CAPTURE(errors.worst.second);
    CAPTURE(errors.worst.x);
    CHECK(errors.ulp <= 2);
    CHECK(errors.outside == 0);
  };
  check(oracle::ellipse_errors<double, float_50, long double>(test::effort(20000, 1000), 1));
  check(oracle::ellipse_errors<double, oracle::float_100, long double>(500, 2, 20));
  check(oracle::ellipse_errors<float, float_50, long double>(1000, 3));
  check(oracle::ellipse_errors<long double, oracle::float_100, long double>(500, 4));
}

TEST_CASE("ellipse: the bisection of the textbook equation gives the same point") {
  oracle::number_source<double> source(6);
  for (int i = 0; i < 500; ++i) {
    double const a = source.positive_of_size(-1, 1), b = source.positive_of_size(-1, 1);
    vec2 const x(source.of_size(-2, 2), source.of_size(-2, 2));
    Eigen::Matrix<long double, 2, 1> const wide = x.cast<long double>();
    auto const twin = naive::project_ellipse<long double>(wide, a, b);
    vec2 const p = ellipse<>(a, b).project(x);
    CHECK((p.cast<long double>() - twin).norm() <= 4 * static_cast<long double>(ε) * twin.norm());
  }
}

TEST_CASE("ellipse: with equal axes it is the disc") {
  oracle::number_source<double> source(7);
  for (int i = 0; i < 500; ++i) {
    double const g = source.positive_of_size(-150, 150);
    vec2 const x = g * source.of_size(-2, 2) * source.direction<2>();
    ellipse<> const set(g, g);
    slant::disc<> const disc(g);
    CHECK((set.project(x) / g - disc.project(x) / g).norm() <= 8 * ε);
    CHECK((set.slant(x) - disc.slant(x)).norm() <= 16 * ε);
    CHECK(set.contains(x) == disc.contains(x));
  }
}

TEST_CASE("ellipse: no smaller distance on the curve, and the variational inequality") {
  oracle::number_source<double> source(8);
  for (int i = 0; i < 60; ++i) {
    double const a = source.positive_of_size(-2, 2), b = source.positive_of_size(-2, 2);
    vec2 const x(source.of_size(-2, 3), source.of_size(-2, 3));
    auto const on_curve = [&](double θ) { return vec2(a * std::cos(θ), b * std::sin(θ)); };
    std::vector<vec2> points{vec2(0, 0)};
    for (double θ = 0; θ < 6.3; θ += 0.3) points.push_back(on_curve(θ));
    ellipse<> const set(a, b);
    oracle::check_variational_inequality(set, x, points);
    double const distance = (x - set.project(x)).norm();
    CHECK(distance <= naive::sampled_distance(x, on_curve, 400) * (1 + 8 * ε));
    // Swapping the axes swaps the components.
    vec2 const swapped = ellipse<>(b, a).project(vec2(x(1), x(0)));
    CHECK(vec2(swapped(1), swapped(0)) == set.project(x));
  }
}

TEST_CASE("ellipse: a power of two in the units changes nothing but the units") {
  oracle::number_source<double> source(9);
  for (int i = 0; i < 200; ++i) {
    vec2 const x(source.of_size(-2, 2), source.of_size(-2, 2));
    double const a = source.positive_of_size(-2, 2), b = source.positive_of_size(-2, 2);
    vec2 const p = ellipse<>(a, b).project(x);
    for (double s : {0x1p-900, 0x1p-500, 0x1p+3, 0x1p+500, 0x1p+900}) {
      CHECK(ellipse<>(s * a, s * b).project(s * x) == s * p);
      CHECK(ellipse<>(s * a, s * b).slant(s * x) == ellipse<>(a, b).slant(x));
    }
  }
}

TEST_CASE("ellipse: aspect ratios beyond all use stay sane") {
  oracle::number_source<double> source(10);
  for (int i = 0; i < 5000; ++i) {
    double const a = source.positive_of_size(-150, 150), b = source.positive_of_size(-150, 150);
    vec2 const x(source.any_size(), source.any_size());
    ellipse<> const set(a, b);
    vec2 const p = set.project(x);
    CHECK(set.contains(p));
    CHECK(std::abs(p(0)) <= std::abs(x(0)));
    CHECK(std::abs(p(1)) <= std::abs(x(1)));
    CHECK(set.contains(set.project(p)));
  }
  // Thinner than the exponent range: the foot on the long axis, and points inside stay.
  ellipse<> const needle(1e155, 1e-155);
  CHECK(needle.project(vec2(3e155, 1e-155)) == vec2(1e155, 0));
  CHECK(needle.project(vec2(1e100, 1e-156)) == vec2(1e100, 1e-156));
  CHECK(needle.project(vec2(0, 1)) == vec2(0, 1e-155));
}

TEST_CASE("ellipse: slanting function off the curve, on it and inside") {
  oracle::number_source<double> source(11);
  for (int i = 0; i < 60; ++i) {
    double const a = source.positive_of_size(-1, 1);
    double const b = a * source.positive_of_size(i % 2 == 0 ? -1 : -8, 0);
    double const θ = source.uniform(0, 6.3);
    vec2 const outwards(std::cos(θ) / a, std::sin(θ) / b);
    double const δ = source.positive_of_size(-2, 1) * a;
    vec2 const x = vec2(a * std::cos(θ), b * std::sin(θ)) + δ * outwards.normalized();
    oracle::hard_point<float_50, 2> problem{float_50(a), float_50(b), {}};
    auto const naive_project = [&](auto const& z) {
      problem.x = z;
      return oracle::precise_ellipse_projection<float_50, long double, float_50>(problem);
    };
    oracle::check_slant(ellipse<>(a, b), x, naive_project, 1e-16 * b, 16);
    CHECK(ellipse<>(a, b).slant(0.5 * ellipse<>(a, b).project(x)) == Eigen::Matrix2d::Identity());
  }
  CHECK(ellipse<>(2, 1).slant(vec2(2, 0)) == Eigen::Matrix2d::Identity());
  CHECK(ellipse<>(2, 1).slant(vec2(0, -1)) == Eigen::Matrix2d::Identity());
  // At the end of the long axis: T = e₁, κ = a/b², so G = 1/(1 + δa/b²).
  CHECK(ellipse<>(2, 1).slant(vec2(5, 0))(1, 1) == doctest::Approx(1.0 / 7.0).epsilon(1e-15));
  CHECK(ellipse<>(1e8, 1).slant(vec2(2e8, 0))(1, 1) == doctest::Approx(1e-16).epsilon(1e-14));
}

TEST_CASE("ellipse: steps agree with bisection in 50 digits at all scales and aspects") {
  using real = float_50;
  using wide = Eigen::Matrix<real, 2, 1>;
  oracle::number_source<double> source(12);
  double worst = 0;
  for (int i = 0; i < 120; ++i) {
    double const a = source.positive_of_size(-140, 140), b = a * source.positive_of_size(-8, 0);
    double const θ = source.uniform(0, 6.3);
    vec2 x(a * std::cos(θ), b * std::sin(θ));
    x *= i % 3 == 0 ? 1 - 4 * ε : i % 3 == 1 ? 1 - source.positive_of_size(-14, 0) / 2 : 0.3;
    vec2 const d(source.of_size(-3, 3), source.of_size(-3, 3));
    real const A(a), B(b), limit = A * A * B * B;
    auto const member = [&](wide const& z) {
      real const u = B * z(0), v = A * z(1);
      return u * u + v * v <= limit;
    };
    worst = std::max(worst, oracle::step_error(ellipse<>(a, b), member, x, d, b));
  }
  CHECK(worst <= 4);
}

TEST_CASE("ellipse: a step from outside by rounding is 0 or leads through the set") {
  oracle::number_source<double> source(13);
  for (int i = 0; i < 2000; ++i) {
    double const a = source.positive_of_size(-100, 100), b = a * source.positive_of_size(-8, 8);
    ellipse<> const set(a, b);
    double const θ = source.uniform(0, 6.3);
    vec2 const x = (1 + 4 * ε) * vec2(a * std::cos(θ), b * std::sin(θ));
    vec2 const d(a * source.of_size(-2, 2), b * source.of_size(-2, 2));
    double const α = set.step_to_boundary(x, d);
    CHECK(α >= 0);
    if (std::cos(θ) * (d(0) / a) + std::sin(θ) * (d(1) / b) > 0) CHECK(α == 0.0);
    vec2 const moved = x + α * d;
    CHECK(std::hypot(moved(0) / a, moved(1) / b) <= 1 + 16 * ε);
  }
}

TEST_CASE("ellipse: support, state and membership") {
  oracle::number_source<double> source(14);
  for (int i = 0; i < 200; ++i) {
    double const a = source.positive_of_size(-100, 100), b = a * source.positive_of_size(-8, 8);
    vec2 const y(source.of_size(-10, 10), source.of_size(-10, 10));
    float_50 const u = float_50(a) * float_50(y(0)), v = float_50(b) * float_50(y(1));
    ellipse<> const set(a, b);
    CHECK(oracle::ulp_distance<double>(set.support(y), float_50(sqrt(u * u + v * v))) <= 4);
    double const θ = source.uniform(0, 6.3);
    vec2 const x(a * std::cos(θ), b * std::sin(θ));
    CHECK(set.state(x) == block_state::sliding);
    CHECK(set.contains(x));
    CHECK(set.state((1 - 40 * ε) * x) == block_state::free);
    CHECK_FALSE(set.contains((1 + 40 * ε) * x));
  }
}

TEST_CASE("ellipse: inequality and its derivatives") {
  using wide = Eigen::Matrix<float_50, 2, 1>;
  oracle::check_inequality_derivatives(ellipse<float_50>(float_50(2), float_50(0.5)),
                                       wide(float_50(1), float_50(-0.25)), float_50(1e-10));
  vec2 const x(1.8 * (1 + 3 * ε), 0.8);
  float_50 const u = float_50(x(0)) / 3, v = float_50(x(1));
  CHECK(oracle::ulp_distance<double>(ellipse<>(3, 1).inequality(x)(0),
                                     float_50(u * u + v * v - 1)) <= 1);
}

TEST_CASE("ellipse: an axis 0 makes a segment or a point") {
  ellipse<> const segment(3, 0), upright(0, 3), single(0, 0);
  CHECK(segment.project(vec2(5, 7)) == vec2(3, 0));
  CHECK(segment.project(vec2(-1, 7)) == vec2(-1, 0));
  CHECK(upright.project(vec2(5, -7)) == vec2(0, -3));
  CHECK(single.project(vec2(5, -7)) == vec2(0, 0));
  CHECK(segment.contains(vec2(3, 0)));
  CHECK_FALSE(segment.contains(vec2(1, 1e-300)));
  CHECK(segment.state(vec2(3, 0)) == block_state::fixed);
  CHECK(segment.state(vec2(1, 0)) == block_state::sliding);
  CHECK(single.state(vec2(0, 0)) == block_state::fixed);
  CHECK(segment.slant(vec2(1, 5)) == vec2(1, 0).asDiagonal().toDenseMatrix());
  CHECK(segment.slant(vec2(4, 5)) == Eigen::Matrix2d::Zero());
  CHECK(single.slant(vec2(0, 0)) == Eigen::Matrix2d::Zero());
  CHECK(segment.step_to_boundary(vec2(1, 0), vec2(2, 0)) == 1.0);
  CHECK(segment.step_to_boundary(vec2(1, 0), vec2(2, 1)) == 0.0);
  CHECK(single.step_to_boundary(vec2(0, 0), vec2(0, 0)) == inf);
  CHECK(single.step_to_boundary(vec2(0, 0), vec2(1, 0)) == 0.0);
  CHECK(segment.support(vec2(-2, 9)) == 6.0);
}

TEST_CASE("ellipse: an infinite axis makes a strip or the plane") {
  ellipse<> const strip(inf, 2), plane(inf, inf), line(0, inf);
  CHECK(strip.project(vec2(1e300, 7)) == vec2(1e300, 2));
  CHECK(plane.project(vec2(1e300, 7)) == vec2(1e300, 7));
  CHECK(line.project(vec2(1e300, 7)) == vec2(0, 7));
  CHECK(strip.contains(vec2(1e300, -2)));
  CHECK(strip.state(vec2(5, -2)) == block_state::sliding);
  CHECK(strip.state(vec2(5, 1)) == block_state::free);
  CHECK(plane.state(vec2(5, 1)) == block_state::free);
  CHECK(line.state(vec2(0, 1)) == block_state::sliding);
  CHECK(strip.slant(vec2(9, 5)) == vec2(1, 0).asDiagonal().toDenseMatrix());
  CHECK(plane.slant(vec2(9, 5)) == Eigen::Matrix2d::Identity());
  CHECK(strip.step_to_boundary(vec2(5, 1), vec2(1, 0)) == inf);
  CHECK(strip.step_to_boundary(vec2(5, 1), vec2(1, 2)) == 0.5);
  CHECK(plane.step_to_boundary(vec2(5, 1), vec2(1, 2)) == inf);
  CHECK(strip.support(vec2(0, 3)) == 6.0);
  CHECK(strip.support(vec2(1, 3)) == inf);
  CHECK(strip.inequality(vec2(5, 1))(0) == -0.75);
}

TEST_CASE("ellipse: NaN stays NaN") {
  for (ellipse<> const& set : {ellipse<>(2, 1), ellipse<>(2, 0), ellipse<>(inf, 1), ellipse<>(0, 0),
                               ellipse<>(inf, inf)}) {
    for (vec2 const& bad : {vec2(quiet_nan, 1), vec2(0, quiet_nan)}) {
      CHECK(set.project(bad).array().isNaN().all());
      CHECK(set.slant(bad).array().isNaN().all());
      CHECK_FALSE(set.contains(bad));
      CHECK(std::isnan(set.step_to_boundary(bad, vec2(1, 0))));
      CHECK(std::isnan(set.step_to_boundary(vec2(0, 0), bad)));
      CHECK(std::isnan(set.support(bad)));
    }
  }
  CHECK(ellipse<>(2, 1).project(vec2(inf, 1)).hasNaN());
  CHECK(ellipse<>(2, 1).slant(vec2(inf, 1)).hasNaN());
}

TEST_CASE("ellipse: bad input is named") {
  using slant::bad_input;
  auto const made = [](double a, double b) {
    return oracle::complaint<bad_input>([=] { return ellipse<>().with(a, b); });
  };
  CHECK(made(-1, 2) == "a: got -1, expected a number >= 0");
  CHECK(made(1, -2) == "b: got -2, expected a number >= 0");
  CHECK(made(quiet_nan, 2) == "a: got nan, expected a number >= 0");
  CHECK(made(1, quiet_nan) == "b: got nan, expected a number >= 0");
  CHECK(made(0, inf).empty());
}

}  // namespace ellipse_test
