// SPDX-License-Identifier: MIT
#include <slant/sets/ellipse.hpp>

#include <support/testing.hpp>
#include "oracle/projection_errors.hpp"
#include "oracle/set_checks.hpp"

namespace ellipse_test {

using oracle::float_50;
using slant::block_state;
using slant::ellipse;

constexpr double ε = std::numeric_limits<double>::epsilon();

TEST_CASE_TEMPLATE("ellipse: known answers", S, float, float_50) {
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

TEST_CASE("ellipse: aspect ratios beyond all use stay sane") {
  oracle::number_source<double> source(10);
  for (int i = 0; i < 5000; ++i) {
    double const a = source.positive_of_size(-150, 150), b = source.positive_of_size(-150, 150);
    Vector2d const x(source.any_size(), source.any_size());
    ellipse<> const set(a, b);
    Vector2d const p = set.project(x);
    CHECK(set.contains(p));
    CHECK(std::abs(p(0)) <= std::abs(x(0)));
    CHECK(std::abs(p(1)) <= std::abs(x(1)));
    CHECK(set.contains(set.project(p)));
  }
  // Thinner than the exponent range: the foot on the long axis, and points inside stay.
  ellipse<> const needle(1e155, 1e-155);
  CHECK(needle.project(Vector2d(3e155, 1e-155)) == Vector2d(1e155, 0));
  CHECK(needle.project(Vector2d(1e100, 1e-156)) == Vector2d(1e100, 1e-156));
  CHECK(needle.project(Vector2d(0, 1)) == Vector2d(0, 1e-155));
  CHECK(ellipse<>(1e170, 1e-170).slant(Vector2d(2e170, 0)) == Eigen::Matrix2d::Zero());
  CHECK(ellipse<>(1.0, 2.1e-292).project(Vector2d(1e17, 0)) == Vector2d(1, 0));
}

TEST_CASE("ellipse: slanting function off the curve, on it and inside") {
  oracle::number_source<double> source(11);
  for (int i = 0; i < 60; ++i) {
    double const a = source.positive_of_size(-1, 1);
    double const b = a * source.positive_of_size(i % 2 == 0 ? -1 : -8, 0);
    double const θ = source.uniform(0, 6.3);
    Vector2d const outwards(std::cos(θ) / a, std::sin(θ) / b);
    double const δ = source.positive_of_size(-2, 1) * a;
    Vector2d const x = Vector2d(a * std::cos(θ), b * std::sin(θ)) + δ * outwards.normalized();
    oracle::hard_point<float_50, 2> problem{float_50(a), float_50(b), {}};
    auto const naive_project = [&](auto const& z) {
      problem.x = z;
      return oracle::precise_ellipse_projection<float_50, long double, float_50>(problem);
    };
    oracle::check_slant(ellipse<>(a, b), x, naive_project, 1e-16 * b, 16);
    CHECK(ellipse<>(a, b).slant(0.5 * ellipse<>(a, b).project(x)) == Eigen::Matrix2d::Identity());
  }
  CHECK(ellipse<>(2, 1).slant(Vector2d(2, 0)) == Eigen::Matrix2d::Identity());
  CHECK(ellipse<>(2, 1).slant(Vector2d(0, -1)) == Eigen::Matrix2d::Identity());
  // At the end of the long axis: T = e₁, κ = a/b², so G = 1/(1 + δa/b²).
  CHECK(ellipse<>(2, 1).slant(Vector2d(5, 0))(1, 1) == doctest::Approx(1.0 / 7.0).epsilon(1e-15));
  CHECK(ellipse<>(1e8, 1).slant(Vector2d(2e8, 0))(1, 1) == doctest::Approx(1e-16).epsilon(1e-14));
}

TEST_CASE("ellipse: support, state and membership") {
  oracle::number_source<double> source(14);
  for (int i = 0; i < 200; ++i) {
    double const a = source.positive_of_size(-100, 100), b = a * source.positive_of_size(-8, 8);
    Vector2d const y(source.of_size(-10, 10), source.of_size(-10, 10));
    float_50 const u = float_50(a) * float_50(y(0)), v = float_50(b) * float_50(y(1));
    ellipse<> const set(a, b);
    CHECK(oracle::ulp_distance<double>(set.support(y), float_50(sqrt(u * u + v * v))) <= 4);
    double const θ = source.uniform(0, 6.3);
    Vector2d const x(a * std::cos(θ), b * std::sin(θ));
    CHECK(set.state(x) == block_state::sliding);
    CHECK(set.contains(x));
    CHECK(set.state((1 - 40 * ε) * x) == block_state::free);
    CHECK_FALSE(set.contains((1 + 40 * ε) * x));
  }
}

TEST_CASE("ellipse: next to the curve the digits of the inequality are right") {
  Vector2d const x(1.8 * (1 + 3 * ε), 0.8);
  float_50 const u = float_50(x(0)) / 3, v = float_50(x(1));
  CHECK(oracle::ulp_distance<double>(ellipse<>(3, 1).inequality(x)(0),
                                     float_50(u * u + v * v - 1)) <= 1);
}

TEST_CASE("ellipse: an axis 0 makes a segment or a point") {
  ellipse<> const segment(3, 0), upright(0, 3), single(0, 0);
  CHECK(segment.project(Vector2d(5, 7)) == Vector2d(3, 0));
  CHECK(segment.project(Vector2d(-1, 7)) == Vector2d(-1, 0));
  CHECK(upright.project(Vector2d(5, -7)) == Vector2d(0, -3));
  CHECK(single.project(Vector2d(5, -7)) == Vector2d(0, 0));
  CHECK(segment.contains(Vector2d(3, 0)));
  CHECK_FALSE(segment.contains(Vector2d(1, 1e-300)));
  CHECK(segment.state(Vector2d(3, 0)) == block_state::fixed);
  CHECK(segment.state(Vector2d(1, 0)) == block_state::sliding);
  CHECK(single.state(Vector2d(0, 0)) == block_state::fixed);
  CHECK(segment.slant(Vector2d(1, 5)) == Vector2d(1, 0).asDiagonal().toDenseMatrix());
  CHECK(segment.slant(Vector2d(4, 5)) == Eigen::Matrix2d::Zero());
  CHECK(single.slant(Vector2d(0, 0)) == Eigen::Matrix2d::Zero());
  CHECK(segment.step_to_boundary(Vector2d(1, 0), Vector2d(2, 0)) == 1.0);
  CHECK(segment.step_to_boundary(Vector2d(1, 0), Vector2d(2, 1)) == 0.0);
  CHECK(single.step_to_boundary(Vector2d(0, 0), Vector2d(0, 0)) == infinity);
  CHECK(single.step_to_boundary(Vector2d(0, 0), Vector2d(1, 0)) == 0.0);
  CHECK(segment.support(Vector2d(-2, 9)) == 6.0);
}

TEST_CASE("ellipse: an infinite axis makes a strip or the plane") {
  ellipse<> const strip(infinity, 2), plane(infinity, infinity), line(0, infinity);
  CHECK(strip.project(Vector2d(1e300, 7)) == Vector2d(1e300, 2));
  CHECK(plane.project(Vector2d(1e300, 7)) == Vector2d(1e300, 7));
  CHECK(line.project(Vector2d(1e300, 7)) == Vector2d(0, 7));
  CHECK(strip.contains(Vector2d(1e300, -2)));
  CHECK(strip.state(Vector2d(5, -2)) == block_state::sliding);
  CHECK(strip.state(Vector2d(5, 1)) == block_state::free);
  CHECK(plane.state(Vector2d(5, 1)) == block_state::free);
  CHECK(line.state(Vector2d(0, 1)) == block_state::sliding);
  CHECK(strip.slant(Vector2d(9, 5)) == Vector2d(1, 0).asDiagonal().toDenseMatrix());
  CHECK(plane.slant(Vector2d(9, 5)) == Eigen::Matrix2d::Identity());
  CHECK(strip.step_to_boundary(Vector2d(5, 1), Vector2d(1, 0)) == infinity);
  CHECK(strip.step_to_boundary(Vector2d(5, 1), Vector2d(1, 2)) == 0.5);
  CHECK(plane.step_to_boundary(Vector2d(5, 1), Vector2d(1, 2)) == infinity);
  CHECK(strip.support(Vector2d(0, 3)) == 6.0);
  CHECK(strip.support(Vector2d(1, 3)) == infinity);
  CHECK(strip.inequality(Vector2d(5, 1))(0) == -0.75);
}

}  // namespace ellipse_test
