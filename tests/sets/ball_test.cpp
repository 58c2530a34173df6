// SPDX-License-Identifier: MIT
#include <slant/sets/ball.hpp>

#include "oracle/projection_errors.hpp"
#include "oracle/set_checks.hpp"
#include "oracle/step_errors.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <support/effort.hpp>
#include <vector>

namespace ball_test {

using oracle::float_50;
using slant::ball;
using slant::block_state;
using vec2 = Eigen::Vector2d;

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double quiet_nan = std::numeric_limits<double>::quiet_NaN();
constexpr double ε = std::numeric_limits<double>::epsilon();

TEST_CASE_TEMPLATE("ball: known answers", S, float, double, long double, float_50) {
  using vec = Eigen::Matrix<S, 2, 1>;
  ball<2, S> const unit;
  CHECK(unit.radius() == S(1));
  auto const disc = unit.with(S(5));
  CHECK(disc.project(vec(S(3), S(4))) == vec(S(3), S(4)));
  CHECK(disc.project(vec(S(6), S(-8))) == vec(S(3), S(-4)));
  CHECK(disc.project(vec(S(0), S(7))) == vec(S(0), S(5)));
  CHECK(disc.support(vec(S(3), S(4))) == S(25));
  CHECK(disc.inequality(vec(S(3), S(3)))(0) == S(-7));
  CHECK(disc.step_to_boundary(vec(S(3), S(0)), vec(S(0), S(2))) == S(2));
  CHECK(disc.step_to_boundary(vec(S(-5), S(0)), vec(S(1), S(0))) == S(10));
  CHECK(disc.step_to_boundary(vec(S(5), S(0)), vec(S(1), S(0))) == S(0));
  CHECK(disc.step_to_boundary(vec(S(5), S(0)), vec(S(0), S(1))) == S(0));
  CHECK(disc.step_to_boundary(vec(S(1), S(0)), vec(S(0), S(0))) ==
        std::numeric_limits<S>::infinity());
}

TEST_CASE("ball: the projection takes any expression, and one number for N = 1") {
  CHECK(slant::disc<>(5.0).project(2.0 * vec2(3, 4)) == vec2(3, 4));
  CHECK(ball<1>(2.0).project(Eigen::Matrix<double, 1, 1>(-7.0))(0) == -2.0);
  CHECK(ball<1>(2.0).project(Eigen::Matrix<double, 1, 1>(inf))(0) == 2.0);
}

TEST_CASE("ball: random and adversarial points within 4 ulp of the 50-digit projection") {
  auto const check = [](auto const& errors, double bound) {
    CAPTURE(errors.worst.first);
    CAPTURE(errors.worst.x);
    CHECK(errors.ulp <= bound);
    CHECK(errors.outside == 0);
  };
  check(oracle::ball_errors<double, float_50, 1>(2000, 1), 1e-30);  // exact: the oracle rounds
  check(oracle::ball_errors<double, float_50, 2>(test::effort(20000, 1000), 2), 4);
  check(oracle::ball_errors<double, float_50, 3>(5000, 3), 4);
  check(oracle::ball_errors<double, float_50, 70>(100, 4), 4);
  check(oracle::ball_errors<float, float_50, 2>(2000, 5), 4);
  check(oracle::ball_errors<long double, float_50, 3>(2000, 6), 4);
}

TEST_CASE("ball: a power of two in the units changes nothing but the units") {
  oracle::number_source<double> source(8);
  for (int i = 0; i < 200; ++i) {
    Eigen::Vector3d const x = source.of_size(-2, 2) * source.direction<3>();
    double const g = source.positive_of_size(-2, 2);
    auto const p = ball<3>(g).project(x);
    for (double s : {0x1p-900, 0x1p-500, 0x1p+3, 0x1p+500, 0x1p+900}) {
      CHECK(ball<3>(s * g).project(s * x) == s * p);
    }
  }
}

TEST_CASE("ball: no smaller distance on the sphere, and the variational inequality") {
  oracle::number_source<double> source(9);
  for (int i = 0; i < 50; ++i) {
    double const g = source.positive_of_size(-2, 2);
    vec2 const x = source.of_size(-2, 3) * source.direction<2>();
    auto const on_sphere = [&](double θ) { return vec2(g * std::cos(θ), g * std::sin(θ)); };
    std::vector<vec2> points{vec2(0, 0)};
    for (double θ = 0; θ < 6.3; θ += 0.3) points.push_back(on_sphere(θ));
    oracle::check_variational_inequality(slant::disc<>(g), x, points);
    double const distance = (x - slant::disc<>(g).project(x)).norm();
    CHECK(distance <= naive::sampled_distance(x, on_sphere, 400) * (1 + 8 * ε));
  }
}

TEST_CASE("ball: state and membership within a few ulp of the sphere") {
  slant::disc<> const disc(5.0);
  CHECK(disc.state(vec2(3, 4)) == block_state::sliding);
  CHECK(disc.state((1 - 4 * ε) * vec2(3, 4)) == block_state::sliding);
  CHECK(disc.state((1 - 40 * ε) * vec2(3, 4)) == block_state::free);
  CHECK(disc.contains((1 + 4 * ε) * vec2(3, 4)));
  CHECK_FALSE(disc.contains((1 + 40 * ε) * vec2(3, 4)));
  CHECK(ball<1>(2.0).state(Eigen::Matrix<double, 1, 1>(2.0)) == block_state::fixed);
  CHECK(ball<1>(2.0).state(Eigen::Matrix<double, 1, 1>(1.0)) == block_state::free);
}

TEST_CASE("ball: radius 0 and infinity") {
  slant::disc<> const none(0.0), plane(inf);
  vec2 const zero(0, 0), x(1e200, -3), y(2, 0);
  CHECK(none.project(x) == zero);
  CHECK(none.contains(zero));
  CHECK(none.state(zero) == block_state::fixed);
  CHECK(none.slant(zero) == Eigen::Matrix2d::Zero());
  CHECK(none.slant(x) == Eigen::Matrix2d::Zero());
  CHECK(none.step_to_boundary(zero, x) == 0.0);
  CHECK(none.support(x) == 0.0);
  CHECK(plane.project(x) == x);
  CHECK(plane.contains(x));
  CHECK(plane.state(x) == block_state::free);
  CHECK(plane.slant(x) == Eigen::Matrix2d::Identity());
  CHECK(plane.step_to_boundary(x, y) == inf);
  CHECK(plane.support(y) == inf);
  CHECK(plane.support(zero) == 0.0);
  CHECK(plane.inequality(y)(0) == -inf);
}

TEST_CASE("ball: slanting function, off the kink and on it [K (50), (51)]") {
  oracle::number_source<double> source(10);
  for (int i = 0; i < 60; ++i) {
    double const g = source.positive_of_size(-1, 1);
    Eigen::Vector3d const x =
        (i % 3 == 0 ? 0.9 * source.uniform(0, 1) : 1.1 + source.uniform(0, 5)) * g *
        source.direction<3>();
    auto const naive_project = [&](auto const& z) {
      return naive::project_ball<float_50, 3>(z, float_50(g));
    };
    oracle::check_slant(ball<3>(g), x, naive_project, 1e-13 * g, 4);
    if (x.norm() > g) CHECK((ball<3>(g).slant(x) * x).norm() <= 4 * ε * g);
  }
  CHECK(slant::disc<>(5.0).slant(vec2(3, 4)) == Eigen::Matrix2d::Identity());
  for (double s : {1e-170, 1e170}) {
    Eigen::Matrix2d const G = slant::disc<>(5 * s).slant(vec2(6 * s, 8 * s));
    CHECK((G - slant::disc<>(5.0).slant(vec2(6, 8))).norm() <= 4 * ε);
  }
  CHECK(slant::disc<>(1e-200).slant(vec2(1e200, 0)).norm() == 0.0);
}

TEST_CASE("ball: steps agree with bisection in 50 digits at all scales") {
  using real = float_50;
  using wide = Eigen::Matrix<real, 2, 1>;
  oracle::number_source<double> source(11);
  double worst = 0;
  for (int i = 0; i < 150; ++i) {
    double const g = source.positive_of_size(-140, 140);
    vec2 const d = source.of_size(-3, 3) * source.direction<2>();
    vec2 x = g * source.direction<2>();
    x *= i % 3 == 0 ? 1 - 4 * ε : i % 3 == 1 ? 1 - source.positive_of_size(-14, 0) / 2 : 0.3;
    real const unit(g);
    auto const member = [&](wide const& z) { return z.squaredNorm() <= unit * unit; };
    worst = std::max(worst, oracle::step_error(slant::disc<>(g), member, x, d, g));
  }
  CHECK(worst <= 4);
}

TEST_CASE("ball: a step from outside by rounding is 0 or leads through the ball") {
  oracle::number_source<double> source(12);
  for (int i = 0; i < 2000; ++i) {
    double const g = source.positive_of_size(-150, 150);
    slant::disc<> const disc(g);
    vec2 const x = (1 + 4 * ε) * disc.project(2 * g * source.direction<2>());
    vec2 const d = source.any_size() * source.direction<2>();
    double const α = disc.step_to_boundary(x, d);
    CHECK(α >= 0);
    if (x.normalized().dot(d.normalized()) > 0) CHECK(α == 0.0);
    vec2 const moved = x + α * d;
    CHECK(moved.stableNorm() <= (1 + 16 * ε) * g);
  }
}

TEST_CASE("ball: support is the largest inner product") {
  oracle::number_source<double> source(13);
  for (int i = 0; i < 200; ++i) {
    double const g = source.positive_of_size(-150, 150);
    vec2 const y = source.of_size(-150, 150) * source.direction<2>();
    float_50 const exact = float_50(g) * oracle::widen<float_50>(y).norm();
    CHECK(oracle::ulp_distance<double>(slant::disc<>(g).support(y), exact) <= 4);
  }
}

TEST_CASE("ball: inequality and its derivatives") {
  using wide = Eigen::Matrix<float_50, 3, 1>;
  oracle::check_inequality_derivatives(ball<3, float_50>(float_50(2)),
                                       wide(float_50(1), float_50(-0.25), float_50(3)),
                                       float_50(1e-10));
  // Next to the sphere all digits of ‖x‖² − g² cancel, and the difference is right all the same.
  vec2 const x(0.6 * (1 + 3 * ε), 0.8);
  float_50 const exact = oracle::widen<float_50>(x).squaredNorm() - 1;
  CHECK(oracle::ulp_distance<double>(slant::disc<>(1.0).inequality(x)(0), exact) <= 1);
}

TEST_CASE("ball: NaN stays NaN") {
  slant::disc<> const disc(1.0);
  for (vec2 const& bad : {vec2(quiet_nan, 1), vec2(0, quiet_nan), vec2(inf, quiet_nan)}) {
    for (double g : {0.0, 1.0, inf}) {
      CHECK(disc.with(g).project(bad).hasNaN());
      CHECK(disc.with(g).slant(bad).hasNaN());
      CHECK_FALSE(disc.with(g).contains(bad));
      CHECK(std::isnan(disc.with(g).step_to_boundary(bad, vec2(1, 0))));
      CHECK(std::isnan(disc.with(g).step_to_boundary(vec2(0, 0), bad)));
      CHECK(std::isnan(disc.with(g).support(bad)));
    }
  }
  CHECK(disc.project(vec2(quiet_nan, 1)).array().isNaN().all());
  CHECK(disc.project(vec2(inf, 1)).array().isNaN().all());
}

TEST_CASE("ball: the ends of the exponent range") {
  double const max = std::numeric_limits<double>::max();
  double const least = std::numeric_limits<double>::denorm_min();
  for (double g : {least, 3 * least, 1e-310, 1e-300, 1e300, max}) {
    for (double size : {least, 1e-320, 1e-300, 1.0, 1e300, max}) {
      slant::disc<> const disc(g);
      vec2 const x(size, -size);
      auto const p = disc.project(x);
      CHECK(disc.contains(p));
      if (!disc.contains(x))
        CHECK(p(0) == doctest::Approx(g * std::sqrt(0.5)).epsilon(1e-14 + 2 * least / g));
    }
  }
}

TEST_CASE("ball: bad input is named") {
  using slant::bad_input;
  auto const made = [](double g) {
    return oracle::complaint<bad_input>([=] { return slant::disc<>().with(g); });
  };
  CHECK(made(-1) == "radius: got -1, expected a number >= 0");
  CHECK(made(quiet_nan) == "radius: got nan, expected a number >= 0");
  CHECK(made(inf).empty());
}

}  // namespace ball_test
