// SPDX-License-Identifier: MIT
#include <slant/sets/elliptic_cone.hpp>

#include "oracle/hard_points.hpp"
#include "oracle/naive_projections.hpp"
#include "oracle/precise.hpp"
#include "oracle/set_checks.hpp"
#include "oracle/step_errors.hpp"

#include <slant/sets/in_metric.hpp>
#include <slant/testing/set_laws.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <support/effort.hpp>

namespace elliptic_cone_test {

using oracle::float_100;
using oracle::float_50;
using oracle::number_source;
using slant::block_state;
using cone = slant::elliptic_cone<>;
using vec3 = Eigen::Vector3d;

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double quiet_nan = std::numeric_limits<double>::quiet_NaN();
constexpr double ε = std::numeric_limits<double>::epsilon();

/// By bisection for s = 1/(1 + t), t the multiplier: p_i (1 + t/μ_i²) = x_i, p_n (1 − t) = x_n.
template <class Real>
Eigen::Matrix<Real, 3, 1> naive_project(Eigen::Matrix<Real, 3, 1> const& x, Real const& μ1,
                                        Real const& μ2) {
  Real const m[] = {μ1 * μ1, μ2 * μ2};
  auto const length = [&](Real const& s) {  // p_n/s
    Real const a = μ1 * x(1) / (1 - s + m[0] * s), b = μ2 * x(2) / (1 - s + m[1] * s);
    return Real(sqrt(Real(a * a + b * b)));
  };
  if (x(0) >= 0 && length(Real(1)) <= x(0)) return x;
  if (length(Real(0)) <= -x(0)) return Eigen::Matrix<Real, 3, 1>::Zero();
  Real lower(0), upper(1);
  for (;;) {
    Real const s = (lower + upper) / 2;
    if (!(s > lower && s < upper)) break;
    ((2 * s - 1) * length(s) < x(0) ? lower : upper) = s;
  }
  Real const s = upper;
  return {s * length(s), s * m[0] * x(1) / (1 - s + m[0] * s),
          s * m[1] * x(2) / (1 - s + m[1] * s)};
}

struct hard_point {
  double μ1, μ2;
  vec3 x;
};

/// Aspect ratios up to 10^aspect; both sides of the mantle and of the polar cone by a few ulp and
/// by any number of digits, the axes, the ends of the long axis.
hard_point hard(number_source<double>& source, int kind, double aspect) {
  hard_point p;
  double const decades = source.choice(8) == 0 ? 10 : 2;
  p.μ1 = source.positive_of_size(-decades, decades);
  p.μ2 = p.μ1 * (source.choice(4) == 0   ? 1.0
                 : source.choice(3) == 0 ? std::pow(10.0, -aspect)
                                         : source.positive_of_size(-aspect, 0));
  double const φ = source.coin() ? source.uniform(0, 6.3) : source.of_size(-17, 0);
  double const c = std::cos(φ), s = std::sin(φ), scale = source.positive_of_size(-70, 70);
  switch (kind % 8) {
    case 0:
      p.x = source.direction<3>();
      break;
    case 1:  // at the mantle, by a few ulp
      p.x << source.nudged(1.0), p.μ1 * c, p.μ2 * s;
      break;
    case 2:  // by any number of digits
      p.x << 1 - source.positive_of_size(-16, 0), p.μ1 * c, p.μ2 * s;
      break;
    case 3:  // at the polar cone, by a few ulp
      p.x << -source.nudged(1.0), c / p.μ1, s / p.μ2;
      break;
    case 4:  // by any number of digits
      p.x << -(1 - source.positive_of_size(-16, 0)), c / p.μ1, s / p.μ2;
      break;
    case 5:  // on an axis, in a plane
      p.x = source.direction<3>();
      p.x(source.choice(3)) = 0;
      break;
    case 6:  // of unrelated size
      p.x << source.of_size(-8, 8), source.of_size(-8, 8), source.of_size(-8, 8);
      break;
    default:  // outside in units of the section
      p.x << source.of_size(-2, 2), p.μ1 * c * source.of_size(-3, 3),
          p.μ2 * s * source.of_size(-3, 3);
  }
  p.x *= scale;
  if (source.coin()) {
    std::swap(p.μ1, p.μ2);
    std::swap(p.x(1), p.x(2));
  }
  return p;
}

TEST_CASE("elliptic cone: hard points within 2 ulp of the 100-digit projection, aspects to 1e8") {
  number_source<double> source(1);
  double worst = 0;
  int outside = 0;
  hard_point at{};
  for (int i = 0; i < test::effort(4000, 800); ++i) {
    auto const p = hard(source, i, 8);
    cone const set(p.μ1, p.μ2);
    auto const exact =
        naive_project<float_100>(oracle::widen<float_100>(p.x), float_100(p.μ1), float_100(p.μ2));
    vec3 const computed = set.project(p.x);
    if (!set.contains(computed)) ++outside;
    double const distance = oracle::ulp_distance<double, 3, float_100>(computed, exact);
    if (distance > worst) {
      worst = distance;
      at = p;
    }
  }
  CAPTURE(at.μ1);
  CAPTURE(at.μ2);
  CAPTURE(at.x);
  CHECK(worst <= 2);
  CHECK(outside == 0);
}

TEST_CASE("elliptic cone: known answers; equal coefficients are the round cone, 0 a flat one") {
  cone const set(3.0, 0.5);
  CHECK(set.project(vec3(1, 3, 0)) == vec3(1, 3, 0));
  CHECK(set.project(vec3(-5, 10, 0)) == vec3(2.5, 7.5, 0));  // (n + μρ)/(1 + μ²) = 25/10
  CHECK(set.project(vec3(-30, 10, 0)) == vec3(0, 0, 0));
  CHECK(set.project(vec3(-10, 0, -20)) == vec3(0, 0, 0));
  CHECK(set.support(vec3(-30, 10, 0)) == 0);
  CHECK(set.support(vec3(-29, 10, 0)) == inf);
  CHECK(set.step_to_boundary(vec3(1, 0, 0), vec3(0, 0, 2)) == 0.25);
  CHECK(set.step_to_boundary(vec3(1, 0, 0), vec3(1, 0, 0.5)) == inf);
  number_source<double> source(2);
  for (int i = 0; i < 200; ++i) {
    double const μ = source.positive_of_size(-3, 3);
    vec3 const x = source.of_size(-100, 100) * source.direction<3>();
    slant::second_order_cone<3> const round(μ);
    cone const same(μ, μ);
    CHECK((same.project(x) - round.project(x)).norm() <= 4 * ε * round.project(x).norm());
    CHECK((same.slant(x) - round.slant(x)).norm() <= 16 * ε);
    cone const flat(0.0, μ);
    vec3 const p = flat.project(x);
    Eigen::Vector2d const q = slant::second_order_cone<2>(μ).project(Eigen::Vector2d(x(0), x(2)));
    CHECK(p == vec3(q(0), 0, q(1)));
    CHECK(flat.contains(p));
  }
  cone const ray(0.0, 0.0);
  CHECK(ray.project(vec3(2, 3, 4)) == vec3(2, 0, 0));
  CHECK(ray.slant(vec3(2, 3, 4)) == vec3(1, 0, 0).asDiagonal().toDenseMatrix());
}

TEST_CASE("elliptic cone: a power of two in the units changes nothing but the units") {
  number_source<double> source(7);
  for (int i = 0; i < 100; ++i) {
    vec3 const x = source.of_size(-2, 2) * source.direction<3>();
    cone const set(source.positive_of_size(-2, 2), source.positive_of_size(-2, 2));
    vec3 const p = set.project(x);
    for (double s : {0x1p-900, 0x1p-500, 0x1p+500, 0x1p+900}) {
      CHECK(set.project(s * x) == s * p);
      CHECK(set.slant(s * x) == set.slant(x));
    }
  }
}

TEST_CASE("elliptic cone: laws") {
  slant::testing::set_options const few{.points = 16, .directions = 3};
  slant::testing::check_set_laws(cone(0.3, 0.6), few);
  slant::testing::check_set_laws(cone(2.0, 0.1), few);
  auto flat = few;
  flat.interior = false;
  slant::testing::check_set_laws(cone(0.5, 0.0), flat);
}

TEST_CASE("elliptic cone: slanting operator against differences in 50 digits") {
  number_source<double> source(9);
  for (int i = 0; i < 40; ++i) {
    double const μ1 = source.positive_of_size(-1, 1), μ2 = source.positive_of_size(-1, 1);
    vec3 x = source.direction<3>();
    double const mantle = std::hypot(x(1) / μ1, x(2) / μ2);
    double const polar = std::hypot(x(1) * μ1, x(2) * μ2);
    // Away from the kinks by at least a tenth of their distance.
    double const between = source.uniform(0.1, 0.9);
    x(0) = i % 4 == 0   ? mantle * (1.1 + source.uniform(0, 3))
           : i % 4 == 1 ? -polar * (1.1 + source.uniform(0, 3))
                        : between * mantle - (1 - between) * polar;
    auto const naive = [&](auto const& z) {
      return naive_project<float_100>(oracle::widen<float_100>(z), float_100(μ1), float_100(μ2))
          .eval();
    };
    auto const narrowed = [&](auto const& z) { return oracle::widen<float_50>(naive(z)); };
    oracle::check_slant(cone(μ1, μ2), x, narrowed, 1e-15, 64);
  }
}

TEST_CASE("elliptic cone: projection moves as its slanting operator says at aspect 1e8") {
  number_source<double> source(12);
  for (int i = 0; i < 20; ++i) {
    cone const set(1.0, 1e-8);
    vec3 x = source.direction<3>();
    x(0) = source.uniform(-0.5, 0.5) * std::abs(x(1));
    double const h = 1e-25;  // relative to the distance to the short axis
    Eigen::Matrix3d const G = set.slant(x);
    auto const p = [&](vec3 const& d, double t) {
      using wide = Eigen::Matrix<float_100, 3, 1>;
      wide const z = oracle::widen<float_100>(x) + float_100(t) * oracle::widen<float_100>(d);
      return naive_project<float_100>(z, float_100(1.0), float_100(1e-8));
    };
    for (int j = 0; j < 3; ++j) {
      auto const change = ((p(vec3::Unit(j), h) - p(vec3::Unit(j), -h)) / float_100(2 * h)).eval();
      for (int k = 0; k < 3; ++k) {
        CHECK(std::abs(double(change(k)) - G(k, j)) <= 64 * ε);
      }
    }
  }
}

TEST_CASE("elliptic cone: state, membership, steps") {
  cone const set(2.0, 0.5);
  vec3 const on_mantle(5, 6, 2);  // (3, 4, 5)
  CHECK(set.state(on_mantle) == block_state::sliding);
  CHECK(set.state(vec3(5 * (1 + 60 * ε), 6, 2)) == block_state::free);
  CHECK(set.contains(vec3(5 * (1 - 4 * ε), 6, 2)));
  CHECK_FALSE(set.contains(vec3(5 * (1 - 60 * ε), 6, 2)));
  CHECK_FALSE(set.contains(vec3(-5, 6, 2)));
  CHECK(set.state(vec3(0, 0, 0)) == block_state::fixed);
  CHECK(set.state(1e-300 * on_mantle) == block_state::sliding);
  CHECK(set.slant(on_mantle) == Eigen::Matrix3d::Identity());
  CHECK(set.slant(vec3(0, 0, 0)) == Eigen::Matrix3d::Identity());
  CHECK(set.slant(vec3(-20, 6, 2)) == Eigen::Matrix3d::Zero());
  CHECK(set.step_to_boundary(on_mantle, -on_mantle) == 1.0);
  CHECK(set.step_to_boundary(on_mantle, on_mantle) == inf);

  using wide = Eigen::Matrix<float_50, 3, 1>;
  number_source<double> source(10);
  double worst = 0;
  for (int i = 0; i < 60; ++i) {
    double const μ1 = source.positive_of_size(-3, 3), μ2 = source.positive_of_size(-3, 3);
    double const n = source.positive_of_size(-130, 130), φ = source.uniform(0, 6.3);
    double const depth = i % 3 == 0   ? 8 * ε
                         : i % 3 == 1 ? source.positive_of_size(-14, 0) / 2
                                      : 0.7;
    vec3 const x = n * vec3(1, (1 - depth) * μ1 * std::cos(φ), (1 - depth) * μ2 * std::sin(φ));
    vec3 const d = source.of_size(-3, 3) * source.direction<3>();
    auto const member = [&](wide const& z) {
      float_50 const a = z(1) / float_50(μ1), b = z(2) / float_50(μ2);
      return z(0) >= 0 && a * a + b * b <= z(0) * z(0);
    };
    worst = std::max(worst, oracle::step_error(cone(μ1, μ2), member, x, d, n));
  }
  CHECK(worst <= 4);
}

TEST_CASE("elliptic cone: inequality and its derivatives; those of the round cone") {
  using wide = Eigen::Matrix<float_50, 3, 1>;
  oracle::check_inequality_derivatives(
      slant::elliptic_cone<float_50>(float_50(0.75), float_50(0.25)),
      wide(float_50(2), float_50(-0.25), float_50(3)), float_50(1e-10));
  vec3 const x(1.25, 0.5, -0.75);
  CHECK(cone(0.5, 0.5).inequality(x) == slant::second_order_cone<3>(0.5).inequality(x));
}

TEST_CASE("elliptic cone: in a metric that makes it round") {
  auto const set = slant::in_metric(cone(2.0, 0.5), vec3(1, 0.25, 4));
  vec3 const x(0, 6, 2);  // in round coordinates (0, 3, 4), to (2.5, 1.5, 2)
  CHECK((set.project(x) - vec3(2.5, 3, 1)).norm() <= 8 * ε);
}

TEST_CASE("elliptic cone: NaN stays NaN, bad input is named") {
  for (double μ : {0.0, 1.0, 2.0}) {
    cone const set(μ, 1.0);
    for (vec3 const& bad : {vec3(quiet_nan, 1, 0), vec3(1, quiet_nan, 0), vec3(-1, 0, quiet_nan)}) {
      CHECK(set.project(bad).array().isNaN().all());
      CHECK(set.slant(bad).array().isNaN().all());
      CHECK_FALSE(set.contains(bad));
      CHECK(std::isnan(set.step_to_boundary(bad, vec3(-1, 0, 0))));
      CHECK(std::isnan(set.support(bad)));
    }
  }
  for (double μ : {0x1p-170, 0x1p170}) {  // the ends of what is legal
    for (vec3 const& x : {vec3(1, 2, 3), vec3(-1, 2, 3), vec3(0, 1, 1), vec3(-1e-30, 1, 1e-40)}) {
      for (cone const& set : {cone(μ, 1.0), cone(1.0, μ), cone(μ, μ)}) {
        CHECK(set.contains(set.project(x)));
        CHECK(set.slant(x).allFinite());
      }
    }
  }
  auto const made = [](double a, double b) {
    return oracle::complaint<slant::bad_input>([=] { return cone(a, b); });
  };
  CHECK(made(-1, 0) == "mu1: got -1, expected 0 or a number in [2^-170, 2^170]");
  CHECK(made(1, inf) == "mu2: got inf, expected 0 or a number in [2^-170, 2^170]");
  CHECK_FALSE(made(1, 1e160).empty());
  CHECK_FALSE(made(1e-160, 1).empty());
}

}  // namespace elliptic_cone_test
