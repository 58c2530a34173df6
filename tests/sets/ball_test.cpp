// SPDX-License-Identifier: MIT
#include <slant/sets/ball.hpp>

#include <support/testing.hpp>
#include "oracle/projection_errors.hpp"
#include "oracle/set_checks.hpp"

namespace ball_test {

using oracle::float_50;
using slant::ball;
using slant::block_state;

constexpr double ε = std::numeric_limits<double>::epsilon();

TEST_CASE_TEMPLATE("ball: known answers", S, float, float_50) {
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
  CHECK(slant::disc<>(5.0).project(2.0 * Vector2d(3, 4)) == Vector2d(3, 4));
  CHECK(ball<1>(2.0).project(Eigen::Matrix<double, 1, 1>(-7.0))(0) == -2.0);
  CHECK(ball<1>(2.0).project(Eigen::Matrix<double, 1, 1>(infinity))(0) == 2.0);
  CHECK(ball<1>(2.0).slant(Eigen::Matrix<double, 1, 1>(infinity))(0) == 0.0);
}

TEST_CASE("ball: state and membership within a few ulp of the sphere") {
  slant::disc<> const disc(5.0);
  CHECK(disc.state(Vector2d(3, 4)) == block_state::sliding);
  CHECK(disc.state((1 - 4 * ε) * Vector2d(3, 4)) == block_state::sliding);
  CHECK(disc.state((1 - 40 * ε) * Vector2d(3, 4)) == block_state::free);
  CHECK(disc.contains((1 + 4 * ε) * Vector2d(3, 4)));
  CHECK_FALSE(disc.contains((1 + 40 * ε) * Vector2d(3, 4)));
  CHECK(ball<1>(2.0).state(Eigen::Matrix<double, 1, 1>(2.0)) == block_state::fixed);
  CHECK(ball<1>(2.0).state(Eigen::Matrix<double, 1, 1>(1.0)) == block_state::free);
}

TEST_CASE("ball: radius 0 and infinity") {
  slant::disc<> const none(0.0), plane(infinity);
  Vector2d const zero(0, 0), x(1e200, -3), y(2, 0);
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
  CHECK(plane.step_to_boundary(x, y) == infinity);
  CHECK(plane.support(y) == infinity);
  CHECK(plane.support(zero) == 0.0);
  CHECK(plane.inequality(y)(0) == -infinity);
  CHECK(slant::disc<>(1e160).inequality(x / 1e45)(0) == -infinity);
}

TEST_CASE("ball: slanting function, off the kink and on it [K (50), (51)]") {
  oracle::number_source<double> source(10);
  for (int i = 0; i < 60; ++i) {
    double const g = source.positive_of_size(-1, 1);
    Vector3d const x = (i % 3 == 0 ? 0.9 * source.uniform(0, 1) : 1.1 + source.uniform(0, 5)) * g *
                       source.direction<3>();
    auto const naive_project = [&](auto const& z) {
      return naive::project_ball<float_50, 3>(z, float_50(g));
    };
    oracle::check_slant(ball<3>(g), x, naive_project, 1e-13 * g, 4);
    if (x.norm() > g) CHECK((ball<3>(g).slant(x) * x).norm() <= 4 * ε * g);
  }
  CHECK(slant::disc<>(5.0).slant(Vector2d(3, 4)) == Eigen::Matrix2d::Identity());
  for (double s : {1e-170, 1e170}) {
    Eigen::Matrix2d const G = slant::disc<>(5 * s).slant(Vector2d(6 * s, 8 * s));
    CHECK((G - slant::disc<>(5.0).slant(Vector2d(6, 8))).norm() <= 4 * ε);
  }
  CHECK(slant::disc<>(1e-200).slant(Vector2d(1e200, 0)).norm() == 0.0);
}

TEST_CASE("ball: support is the largest inner product") {
  oracle::number_source<double> source(13);
  for (int i = 0; i < 200; ++i) {
    double const g = source.positive_of_size(-150, 150);
    Vector2d const y = source.of_size(-150, 150) * source.direction<2>();
    float_50 const exact = float_50(g) * oracle::widen<float_50>(y).norm();
    CHECK(oracle::ulp_distance<double>(slant::disc<>(g).support(y), exact) <= 4);
  }
}

TEST_CASE("ball: next to the sphere all digits of ‖x‖² − g² cancel, the difference is right") {
  Vector2d const x(0.6 * (1 + 3 * ε), 0.8);
  float_50 const exact = oracle::widen<float_50>(x).squaredNorm() - 1;
  CHECK(oracle::ulp_distance<double>(slant::disc<>(1.0).inequality(x)(0), exact) <= 1);
}

TEST_CASE("ball: the ends of the exponent range") {
  double const max = std::numeric_limits<double>::max();
  double const least = std::numeric_limits<double>::denorm_min();
  for (double g : {least, 3 * least, 1e-310, 1e-300, 1e300, max}) {
    for (double size : {least, 1e-320, 1e-300, 1.0, 1e300, max}) {
      slant::disc<> const disc(g);
      Vector2d const x(size, -size);
      auto const p = disc.project(x);
      CHECK(disc.contains(p));
      if (!disc.contains(x))
        CHECK(p(0) == doctest::Approx(g * std::sqrt(0.5)).epsilon(1e-14 + 2 * least / g));
    }
  }
}

}  // namespace ball_test
