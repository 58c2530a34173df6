// SPDX-License-Identifier: MIT
//
// What the blocks of the library have in common: projections and steps as precise as the numbers
// allow, at all scales; units that do not matter; NaN that stays NaN; bad parameters that are named.
#include <slant/sets/sets.hpp>
#include <slant/testing/archetypes.hpp>

#include <oracle/naive_projections.hpp>
#include <oracle/precise.hpp>
#include <oracle/projection_errors.hpp>
#include <support/testing.hpp>

namespace primitives_test {

using oracle::float_50;
using source = oracle::number_source<double>;
using cone = slant::second_order_cone<3>;
using S = slant::testing::archetype::scalar;
constexpr double ε = std::numeric_limits<double>::epsilon();

TEST_CASE("projections at random and adversarial points: within some ulp of 50 digits") {
  int const many = test::effort(20000, 1000);
  auto const check = [](auto const& errors, double bound) {
    CAPTURE(errors.worst.first);
    CAPTURE(errors.worst.second);
    CAPTURE(errors.worst.x);
    CHECK(errors.ulp <= bound);
    CHECK(errors.outside == 0);
  };
  auto const half_line = [](double l, double) { return slant::half_line<double>(l); };
  auto const interval = [](double l, double u) { return slant::interval<double>(l, u); };
  check(oracle::bound_errors(half_line, false, 20000, 11), 0);
  check(oracle::bound_errors(interval, true, 20000, 12), 0);
  check(oracle::ball_errors<double, float_50, 1>(2000, 1), 1e-30);  // exact: the oracle rounds
  check(oracle::ball_errors<double, float_50, 2>(many, 2), 4);
  check(oracle::ball_errors<double, float_50, 3>(5000, 3), 4);
  check(oracle::ball_errors<double, float_50, 70>(100, 4), 4);
  check(oracle::ball_errors<float, float_50, 2>(2000, 5), 4);
  check(oracle::ball_errors<long double, float_50, 3>(2000, 6), 4);
  check(oracle::ellipse_errors<double, float_50, long double>(many, 1), 2);
  check(oracle::ellipse_errors<double, oracle::float_100, long double>(500, 2, 20), 2);
  check(oracle::ellipse_errors<float, float_50, long double>(1000, 3), 2);
  check(oracle::ellipse_errors<long double, oracle::float_100, long double>(500, 4), 2);
  check(oracle::cone_errors<double, float_50, 2>(2000, 1), 2);
  check(oracle::cone_errors<double, float_50, 3>(many, 2), 2);
  check(oracle::cone_errors<double, float_50, 10>(500, 3), 2);
  check(oracle::cone_errors<float, float_50, 3>(2000, 4), 2);
  check(oracle::cone_errors<long double, float_50, 3>(2000, 5), 2);
}

/// set_in(s) is a set in units of s, x a point in units of one.
template <class SetIn, class Point>
void check_units(SetIn const& set_in, Point const& x, bool slants) {
  Point const p = set_in(1.0).project(x);
  for (double s : {0x1p-900, 0x1p-500, 0x1p+3, 0x1p+500, 0x1p+900}) {
    CHECK(set_in(s).project(Point(s * x)) == s * p);
    if (slants) CHECK(set_in(s).slant(Point(s * x)) == set_in(1.0).slant(x));
  }
}

TEST_CASE("a power of two in the units changes nothing but the units") {
  source numbers(8);
  for (int i = 0; i < 200; ++i) {
    double const a = numbers.positive_of_size(-2, 2), b = numbers.positive_of_size(-2, 2);
    Vector3d const x = numbers.of_size(-2, 2) * numbers.direction<3>();
    check_units([=](double s) { return slant::ball<3>(s * a); }, x, false);
    check_units([=](double s) { return slant::ellipse<>(s * a, s * b); },
                Vector2d(numbers.of_size(-2, 2), numbers.of_size(-2, 2)), true);
    check_units([=](double) { return cone(a); }, x, true);
  }
}

/// How far inside of the boundary a step begins: 4 ulp, any number of digits, or far.
double depth(int i, source& numbers, double far) {
  return i % 3 == 0 ? 4 * ε : i % 3 == 1 ? numbers.positive_of_size(-14, 0) / 2 : far;
}

/// Error in ulp of set.step_to_boundary(x, d), for x of the size `size` and any d of the size 1;
/// member(z) says in 50 digits whether z is in the set. 0 if x is not.
template <class Set, class Member, int N>
double step_error(Set const& set, Member const& member, Eigen::Matrix<double, N, 1> const& x,
                  Eigen::Matrix<double, N, 1> const& d, double size) {
  using wide = Eigen::Matrix<float_50, N, 1>;
  wide const from = oracle::widen<float_50>(x), along = oracle::widen<float_50>(d);
  if (!member(from)) return 0;
  double const α = set.step_to_boundary(x, d);
  float_50 const unit(size);
  float_50 const exact =
      naive::exit_step<float_50>(member, from, wide(along * unit), float_50(1e40)) * unit;
  if (exact < 0) {  // for ever inside
    CHECK(α == std::numeric_limits<double>::infinity());
    return 0;
  }
  return oracle::ulp_distance<double>(α, exact);
}

TEST_CASE("steps agree with bisection in 50 digits at all scales and aspects") {
  using plane = Eigen::Matrix<float_50, 2, 1>;
  using space = Eigen::Matrix<float_50, 3, 1>;
  source numbers(11);
  double of_disc = 0, of_ellipse = 0, of_cone = 0;
  for (int i = 0; i < 150; ++i) {
    double const a = numbers.positive_of_size(-140, 140), b = a * numbers.positive_of_size(-8, 0);
    float_50 const A(a), B(b), limit = A * A * B * B;
    auto const in_disc = [&](plane const& z) { return z.squaredNorm() <= A * A; };
    Vector2d const x = a * (1 - depth(i, numbers, 0.7)) * numbers.direction<2>();
    Vector2d const d = numbers.of_size(-3, 3) * numbers.direction<2>();
    of_disc = std::max(of_disc, step_error(slant::disc<>(a), in_disc, x, d, a));

    auto const in_ellipse = [&](plane const& z) {
      float_50 const u = B * z(0), v = A * z(1);
      return u * u + v * v <= limit;
    };
    double const θ = numbers.uniform(0, 6.3);
    Vector2d const y = (1 - depth(i, numbers, 0.7)) * Vector2d(a * std::cos(θ), b * std::sin(θ));
    Vector2d const e(numbers.of_size(-3, 3), numbers.of_size(-3, 3));
    of_ellipse = std::max(of_ellipse, step_error(slant::ellipse<>(a, b), in_ellipse, y, e, b));

    double const μ = numbers.positive_of_size(-3, 3), n = numbers.positive_of_size(-130, 130);
    float_50 const M(μ);
    auto const in_cone = [&](space const& z) {
      return z(0) >= 0 && z(1) * z(1) + z(2) * z(2) <= M * M * z(0) * z(0);
    };
    Vector3d z(n, 0, 0);
    z.tail<2>() = (1 - depth(i, numbers, 0.7)) * μ * n * numbers.direction<2>();
    Vector3d const f = numbers.of_size(-3, 3) * numbers.direction<3>();
    of_cone = std::max(of_cone, step_error(cone(μ), in_cone, z, f, n));
  }
  CHECK(of_disc <= 4);
  CHECK(of_ellipse <= 4);
  CHECK(of_cone <= 4);
}

TEST_CASE("a step from outside by rounding is 0 or leads through the set") {
  source numbers(12);
  auto const check = [](auto const& set, double a, double b, Vector2d const& x, Vector2d const& d) {
    double const α = set.step_to_boundary(x, d);
    CHECK(α >= 0);
    if (x(0) / a * (d(0) / a) + x(1) / b * (d(1) / b) > 0) CHECK(α == 0.0);
    Vector2d const moved = x + α * d;
    CHECK(std::hypot(moved(0) / a, moved(1) / b) <= 1 + 16 * ε);
  };
  for (int i = 0; i < 2000; ++i) {
    double const a = numbers.positive_of_size(-100, 100), b = a * numbers.positive_of_size(-8, 8);
    double const θ = numbers.uniform(0, 6.3);
    Vector2d const x = (1 + 4 * ε) * Vector2d(std::cos(θ), std::sin(θ));
    Vector2d const d(numbers.of_size(-2, 2), numbers.of_size(-2, 2));
    check(slant::disc<>(a), a, a, a * x, a * d);
    check(slant::ellipse<>(a, b), a, b, Vector2d(a * x(0), b * x(1)), Vector2d(a * d));
    // Directions of any size.
    double const g = numbers.positive_of_size(-150, 150);
    double const α = slant::disc<>(g).step_to_boundary(g * x, numbers.any_size() * d);
    CHECK(α >= 0);
  }
}

/// Whatever is asked with a NaN in it answers NaN; such a point is in no set. inside: a point of it.
template <class Set>
void check_nan(Set const& set, typename Set::vector_type const& inside, bool all = true) {
  using point = typename Set::vector_type;
  for (int i = 0; i < Set::dimension; ++i) {
    for (double const rest : {0.0, 1.0, -1.0}) {
      point bad = point::Constant(rest);
      bad(i) = quiet_nan;
      CHECK(set.project(bad).hasNaN());
      CHECK(set.slant(bad).hasNaN());
      if (all) {
        CHECK(set.project(bad).array().isNaN().all());
        CHECK(set.slant(bad).array().isNaN().all());
      }
      CHECK_FALSE(set.contains(bad));
      CHECK(std::isnan(set.step_to_boundary(bad, point(point::Unit(0)))));
      CHECK(std::isnan(set.step_to_boundary(inside, bad)));
      CHECK(std::isnan(set.support(bad)));
    }
  }
}

TEST_CASE("NaN stays NaN") {
  using number = Eigen::Matrix<double, 1, 1>;
  number const zero(0.0);
  Vector2d const origin(0, 0);
  check_nan(slant::half_line<>{}, number(1.0));
  check_nan(slant::interval<>{}, number(0.5));
  check_nan(slant::interval<>(0.0, 0.0), zero);
  for (double g : {0.0, 1.0, infinity}) check_nan(slant::disc<>(g), origin, g == 1);
  for (slant::ellipse<> const& set :
       {slant::ellipse<>(2, 1), slant::ellipse<>(2, 0), slant::ellipse<>(infinity, 1),
        slant::ellipse<>(0, 0), slant::ellipse<>(infinity, infinity)}) {
    check_nan(set, origin);
  }
  for (double μ : {0.0, 1.0, 1e200}) check_nan(cone(μ), Vector3d(1, 0, 0));
  check_nan(slant::point<2>{}, origin);
  check_nan(slant::free_space<2>{}, origin, false);
  CHECK(std::isnan(slant::half_line<>{}.inequality(number(quiet_nan))(0)));
  // Infinity has no nearest point on a curve.
  CHECK(slant::disc<>(1.0).project(Vector2d(infinity, 1)).array().isNaN().all());
  CHECK(slant::ellipse<>(2, 1).project(Vector2d(infinity, 1)).hasNaN());
  CHECK(slant::ellipse<>(2, 1).slant(Vector2d(infinity, 1)).hasNaN());
  CHECK(cone(1.0).project(Vector3d(infinity, 1, 0)).hasNaN());
}

TEST_CASE("bad parameters are named") {
  auto const half_line = [](double l) {
    return test::complaint([=] { (void)slant::half_line<>().with(l); });
  };
  CHECK(half_line(quiet_nan) == "l: got nan, expected a number less than infinity");
  CHECK(half_line(infinity) == "l: got inf, expected a number less than infinity");
  auto const interval = [](double l, double u) {
    return test::complaint([=] { (void)slant::interval<>().with(l, u); });
  };
  CHECK(interval(2.0, 1.0) == "l: got 2, expected a number <= u = 1");
  CHECK(interval(quiet_nan, 1.0) == "l: got nan, expected a number less than infinity");
  CHECK(interval(infinity, infinity) == "l: got inf, expected a number less than infinity");
  CHECK(interval(0.0, quiet_nan) == "u: got nan, expected a number greater than -infinity");
  CHECK(interval(-infinity, -infinity) == "u: got -inf, expected a number greater than -infinity");
  CHECK(interval(-infinity, infinity) == "nothing thrown");
  auto const disc = [](double g) {
    return test::complaint([=] { (void)slant::disc<>().with(g); });
  };
  CHECK(disc(-1) == "radius: got -1, expected a number >= 0");
  CHECK(disc(quiet_nan) == "radius: got nan, expected a number >= 0");
  CHECK(disc(infinity) == "nothing thrown");
  auto const ellipse = [](double a, double b) {
    return test::complaint([=] { (void)slant::ellipse<>().with(a, b); });
  };
  CHECK(ellipse(-1, 2) == "a: got -1, expected a number >= 0");
  CHECK(ellipse(1, -2) == "b: got -2, expected a number >= 0");
  CHECK(ellipse(quiet_nan, 2) == "a: got nan, expected a number >= 0");
  CHECK(ellipse(1, quiet_nan) == "b: got nan, expected a number >= 0");
  CHECK(ellipse(0, infinity) == "nothing thrown");
  auto const of_cone = [](double μ) { return test::complaint([=] { (void)cone().with(μ); }); };
  CHECK(of_cone(-1) == "mu: got -1, expected a finite number >= 0");
  CHECK(of_cone(infinity) == "mu: got inf, expected a finite number >= 0");
  CHECK(of_cone(quiet_nan) == "mu: got nan, expected a finite number >= 0");
  CHECK(of_cone(0) == "nothing thrown");
  auto const point = [](double a, double b) {
    return test::complaint([=] { (void)slant::point<2>(Vector2d(a, b)); });
  };
  CHECK(point(1.0, quiet_nan) == "p(1): got nan, expected a finite number");
  CHECK(point(-infinity, 0.0) == "p(0): got -inf, expected a finite number");
  CHECK(point(1.0, 2.0) == "nothing thrown");
}

template <class C, class D>
void compare(C const& strict, D const& plain) {
  constexpr int n = D::dimension;
  Eigen::Matrix<double, n, 1> x, d;
  Eigen::Matrix<S, n, 1> X, direction;
  for (int i = 0; i < n; ++i) {
    x[i] = 1.5 + i;
    d[i] = -1.0 + i;
    X[i] = S(x[i]);
    direction[i] = S(d[i]);
  }
  Eigen::Matrix<double, n, 1> const p = plain.project(x);
  Eigen::Matrix<S, n, 1> const P = strict.project(X);
  Eigen::Matrix<double, n, n> const g = plain.slant(x);
  Eigen::Matrix<S, n, n> const G = strict.slant(X);
  for (int i = 0; i < n; ++i) {
    CHECK(P[i].value() == p[i]);
    for (int j = 0; j < n; ++j) CHECK(G(i, j).value() == g(i, j));
  }
  CHECK(strict.contains(P) == plain.contains(p));
  CHECK(strict.state(P) == plain.state(p));
  CHECK(strict.step_to_boundary(P, direction).value() == plain.step_to_boundary(p, d));
  CHECK(strict.support(X).value() == plain.support(x));
}

TEST_CASE("sets of the least that is a scalar") {
  compare(slant::ball<2, S>{S(1)}, slant::ball<2>{1.0});
  compare(slant::ellipse<S>{S(1), S(2)}, slant::ellipse<>{1.0, 2.0});
  compare(slant::second_order_cone<3, S>{S(1)}, slant::second_order_cone<3>{1.0});
  compare(slant::half_line<S>{S(1)}, slant::half_line<>{1.0});
  compare(slant::interval<S>{S(0), S(1)}, slant::interval<>{0.0, 1.0});
  compare(slant::free_space<2, S>{}, slant::free_space<2>{});
}

}  // namespace primitives_test
