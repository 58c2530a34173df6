// SPDX-License-Identifier: MIT
#include <slant/slant.hpp>

#include <support/testing.hpp>

namespace normal_part_test {

using slant::split_gradient;
using vec1 = Eigen::Matrix<double, 1, 1>;

/// sᵀx + g‖s‖ in the long type: the gap on a disc by its definition.
long double gap_on_disc(Vector2d const& x, Vector2d const& s, double radius) {
  long double const inner =
      static_cast<long double>(s(0)) * x(0) + static_cast<long double>(s(1)) * x(1);
  return inner +
         static_cast<long double>(radius) * std::hypot(static_cast<long double>(s(0)), s(1));
}

double value(double m, VectorXd const& rest, double gap) {
  return m * rest.squaredNorm() + 4 * gap;
}

TEST_CASE("half line: on the bound all of a pressing gradient is balanced, none of a pulling one") {
  slant::half_line<double> const block(1.0);
  auto part = split_gradient<slant::half_line<double>, double, 1>(block, vec1(1.0), vec1(3.0), 0.5);
  CHECK(part.rest(0) == 0);
  CHECK(part.gap == 0);
  part = split_gradient<slant::half_line<double>, double, 1>(block, vec1(1.0), vec1(-3.0), 0.5);
  CHECK(part.rest(0) == -3);
  CHECK(part.gap == 0);
  // h = 0.25 off the bound, ρ = 0.5: s = 3 − 0.5, γ = s h.
  part = split_gradient<slant::half_line<double>, double, 1>(block, vec1(1.25), vec1(3.0), 0.5);
  CHECK(part.rest(0) == 0.5);
  CHECK(part.gap == 2.5 * 0.25);
  // Far off the bound nothing is balanced; without stiffness everything is.
  part = split_gradient<slant::half_line<double>, double, 1>(block, vec1(9.0), vec1(3.0), 0.5);
  CHECK(part.rest(0) == 3);
  part =
      split_gradient<slant::half_line<double>, double, 1>(block, vec1(1.25), vec1(3.0), infinity);
  CHECK(part.rest(0) == 0);
  CHECK(part.gap == 0.75);
}

TEST_CASE(
    "interval: each end balances its own sign; equal ends balance all; infinite ones nothing") {
  slant::interval<double> const block(-1, 2);
  auto const split = [](auto const& b, double x, double g) {
    return split_gradient<std::remove_cvref_t<decltype(b)>, double, 1>(b, vec1(x), vec1(g), 0.5);
  };
  CHECK(split(block, -1, 3).rest(0) == 0);
  CHECK(split(block, 2, -3).rest(0) == 0);
  CHECK(split(block, -1, -3).rest(0) == -3);
  CHECK(split(block, 1.75, -3).rest(0) == -0.5);
  CHECK(split(slant::interval<double>(4, 4), 4, 5).rest(0) == 0);
  CHECK(split(slant::interval<double>(4, 4), 4, -5).rest(0) == 0);
  CHECK(split(slant::interval<double>(-infinity, infinity), 4, -5).rest(0) == -5);
  CHECK(split(slant::interval<double>(-infinity, infinity), 4, -5).gap == 0);
}

TEST_CASE("disc: the gap is that of the definition, and no other s gives a smaller value") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int i = 0; i < 3000; ++i) {
    double const radius = std::exp2(20 * uniform(random)), ρ = std::exp2(10 * uniform(random));
    slant::ball<2> const block(radius);
    Vector2d x(uniform(random), uniform(random));
    bool const on_sphere = i % 2 == 0;
    x *= on_sphere ? radius / x.norm() : radius * uniform(random) / (1.5 * x.norm());
    Vector2d const g =
        radius / ρ * std::exp2(8 * uniform(random)) * Vector2d(uniform(random), uniform(random));
    auto const part = split_gradient<slant::ball<2>, double, 2>(block, x, g, ρ);
    Vector2d const s = g - part.rest;
    long double const exact = gap_on_disc(x, s, radius);
    double const size = radius * (s.norm() + g.norm());
    CHECK(part.gap >= 0);
    CHECK(std::abs(static_cast<double>(part.gap - exact)) <= 1e-14 * size);
    for (int k = 0; k < 5; ++k) {
      Vector2d const other =
          s + s.norm() * std::exp2(-8.0 * k) * Vector2d(uniform(random), uniform(random));
      double const γ = static_cast<double>(std::fmax(0.0L, gap_on_disc(x, other, radius)));
      CHECK(value(2 * ρ, part.rest, part.gap) <=
            value(2 * ρ, g - other, γ) * (1 + 1e-12) + 1e-13 * size);
    }
  }
}

TEST_CASE("disc: near the solution the gap has all its digits, where its definition has none") {
  // x on the circle, g = −n + η t: the rest is of the size η, the gap of η².
  double const radius = 3, ρ = 0.5;
  for (double const η : {1e-3, 1e-6, 1e-9, 1e-12}) {
    Vector2d const n(0.6, 0.8), t(-0.8, 0.6);
    Vector2d const x = radius * n, g = -n + η * t;
    auto const part = split_gradient<slant::ball<2>, double, 2>(slant::ball<2>(radius), x, g, ρ);
    // z = 3.5 n − η/2 t: sin = η/7 to first order, s = (|z| − 3)/ρ = 1, γ = 3 sin²/2.
    CHECK(part.gap == doctest::Approx(3 * η * η / 98).epsilon(1e-2));
    CHECK(part.rest.norm() == doctest::Approx(η * 6 / 7).epsilon(1e-3));
  }
}

TEST_CASE("disc: what x is off the circle counts, as far as no projection leaves it there") {
  constexpr double ε = std::numeric_limits<double>::epsilon();
  double const ρ = 0.5;
  Vector2d const n(0, 1), g = -n;
  for (double const off : {-8 * ε, -4 * ε, 4 * ε, 8 * ε}) {
    Vector2d const x = (1 + off) * n;
    auto const part = split_gradient<slant::ball<2>, double, 2>(slant::ball<2>(1.0), x, g, ρ);
    CHECK(part.rest.norm() >= 0.9 * std::abs(off));  // of 1/(2ρ) = 1 in the units of the gradient
    CHECK(part.rest.norm() <= 3 * std::abs(off));
  }
  auto const part = split_gradient<slant::ball<2>, double, 2>(slant::ball<2>(1.0), n, g, ρ);
  CHECK(part.rest.norm() == 0);
}

TEST_CASE("radius 0 and ∞, points, free blocks") {
  Vector2d const x(0, 0), g(3, 4);
  auto const none = split_gradient<slant::ball<2>, double, 2>(slant::ball<2>(0.0), x, g, 1.0);
  CHECK(none.rest == Vector2d(0, 0));
  CHECK(none.gap == 0);
  CHECK(split_gradient<slant::ball<2>, double, 2>(slant::ball<2>(infinity), x, g, 1.0).rest == g);
  CHECK(split_gradient<slant::point<2>, double, 2>(slant::point<2>(), x, g, 1.0).rest ==
        Vector2d(0, 0));
  CHECK(split_gradient<slant::free_space<2>, double, 2>({}, x, g, 1.0).rest == g);
}

TEST_CASE("any set with a projection: an ellipse that is a disc splits as the disc does") {
  slant::ellipse<double> const ellipse(2, 2);
  slant::ball<2> const disc(2);
  static_assert(!slant::has_exact_normal_part<slant::ellipse<double>>);
  static_assert(slant::has_exact_normal_part<slant::ball<2>>);
  for (Vector2d const& g : {Vector2d(-3, 1), Vector2d(3, 1), Vector2d(-0.1, 0.2), Vector2d(0, 0)}) {
    for (Vector2d const& x : {Vector2d(2, 0), Vector2d(0.5, 0.5)}) {
      auto const a = split_gradient<slant::ellipse<double>, double, 2>(ellipse, x, g, 0.5);
      auto const b = split_gradient<slant::ball<2>, double, 2>(disc, x, g, 0.5);
      CHECK((a.rest - b.rest).norm() <= 1e-14);
      CHECK(std::abs(a.gap - b.gap) <= 1e-13);
    }
  }
}

TEST_CASE("what leads from a rounded point to the sphere") {
  for (int i = 1; i < 200; ++i) {
    double const R = 0.1 * i;
    Vector2d const x(R * std::cos(0.7 * i), R * std::sin(0.7 * i));
    Vector2d const off = slant::to_sphere<double>(x, R);
    CHECK(off.norm() <= 1e-15 * R);
    long double const a = static_cast<long double>(x(0)) + off(0),
                      b = static_cast<long double>(x(1)) + off(1);
    CHECK(std::abs(double(std::sqrt(a * a + b * b) / R - 1)) <= 1e-18);
  }
  CHECK(slant::to_sphere<double>(Vector2d(0.5, 0), 1.0) == Vector2d(0, 0));
  CHECK(slant::to_sphere<double>(Vector2d(0, 0), 0.0) == Vector2d(0, 0));
}

TEST_CASE("units: powers of two change nothing but the exponent") {
  Vector2d const x(1.2, 1.6), g(-2, -1);
  auto const one = split_gradient<slant::ball<2>, double, 2>(slant::ball<2>(2.0), x, g, 0.25);
  for (double const s : {0x1p-300, 0x1p300}) {
    auto const other =
        split_gradient<slant::ball<2>, double, 2>(slant::ball<2>(2 * s), s * x, g, 0.25 * s);
    CHECK(other.rest == one.rest);
    CHECK(other.gap == s * one.gap);
  }
}

}  // namespace normal_part_test
