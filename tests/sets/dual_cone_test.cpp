// SPDX-License-Identifier: MIT
#include <slant/sets/dual_cone.hpp>

#include "oracle/projection_errors.hpp"
#include "oracle/set_checks.hpp"
#include "oracle/step_errors.hpp"

#include <slant/testing/set_laws.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <support/effort.hpp>

namespace dual_cone_test {

using oracle::float_50;
using slant::block_state;
using cone = slant::second_order_cone<3>;
using dual3 = slant::dual_cone<3>;
using vec3 = Eigen::Vector3d;

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double quiet_nan = std::numeric_limits<double>::quiet_NaN();
constexpr double ε = std::numeric_limits<double>::epsilon();

/// The three cases of μ‖x_t‖ <= x_n.
template <class Real, int N>
Eigen::Matrix<Real, N, 1> naive_project(Eigen::Matrix<Real, N, 1> const& x, Real const& μ) {
  Real squares(0);
  for (int i = 1; i < N; ++i) squares += x(i) * x(i);
  Real const ρ = sqrt(squares);
  if (μ * ρ <= x(0)) return x;
  if (μ * x(0) + ρ <= Real(0)) return Eigen::Matrix<Real, N, 1>::Zero();
  Real const sum = (μ * x(0) + ρ) / (Real(1) + μ * μ);
  Eigen::Matrix<Real, N, 1> p = Real(ρ == Real(0) ? Real(1) : Real(sum / ρ)) * x;
  p(0) = μ * sum;
  return p;
}

TEST_CASE_TEMPLATE("dual cone: known answers", S, float, double, float_50) {
  using vec = Eigen::Matrix<S, 3, 1>;
  slant::dual_cone<3, S> const set(S(2));
  vec const zero(S(0), S(0), S(0));
  CHECK(set.project(vec(S(10), S(3), S(4))) == vec(S(10), S(3), S(4)));
  CHECK(set.project(vec(S(-5), S(6), S(8))) == zero);
  // μ = 3: μn + ρ = 20, 1 + μ² = 10, p_n = 6, p_t = 2 e.
  CHECK(set.with(S(3)).project(vec(S(2.5), S(12.5), S(0))) == vec(S(6), S(2), S(0)));
  CHECK(set.support(vec(S(-3), S(6), S(0))) == S(0));
  CHECK(set.support(vec(S(-3), S(6.5), S(0))) == std::numeric_limits<S>::infinity());
  CHECK(set.inequality(vec(S(1), S(2), S(1)))(0) == S(19));
  CHECK(set.step_to_boundary(vec(S(4), S(0), S(0)), vec(S(0), S(0), S(4))) == S(0.5));
  CHECK(set.step_to_boundary(vec(S(1), S(0), S(0)), vec(S(-2), S(0), S(0))) == S(0.5));
  CHECK(set.step_to_boundary(vec(S(1), S(0), S(0)), vec(S(2), S(0), S(1))) ==
        std::numeric_limits<S>::infinity());
}

template <class S, int N>
oracle::projection_errors<S, N> errors(int count, unsigned seed) {
  oracle::number_source<S> source(seed);
  oracle::projection_errors<S, N> found;
  for (int i = 0; i < count; ++i) {
    // Points that are hard for −K are hard for K*.
    auto p = oracle::hard_cone_point<S, N>(source, i);
    p.x = -p.x;
    auto const exact = naive_project<float_50, N>(oracle::widen<float_50>(p.x), float_50(p.first));
    found.record(slant::dual_cone<N, S>(p.first), p, exact,
                 float_50((std::numeric_limits<S>::min)()));
  }
  return found;
}

TEST_CASE("dual cone: random and adversarial points within 2 ulp of the 50-digit projection") {
  auto const check = [](auto const& e) {
    CAPTURE(e.worst.first);
    CAPTURE(e.worst.x);
    CHECK(e.ulp <= 2);
    CHECK(e.outside == 0);
  };
  check(errors<double, 2>(2000, 1));
  check(errors<double, 3>(test::effort(20000, 1000), 2));
  check(errors<float, 3>(2000, 4));
}

TEST_CASE("dual cone: Moreau, x = P_K*(x) − P_K(−x), the parts orthogonal; G + G_K(−x) = I") {
  oracle::number_source<double> source(8);
  for (int i = 0; i < 300; ++i) {
    auto const p = oracle::hard_cone_point<double, 3>(source, i);
    if (!p.x.allFinite() || p.x.norm() > 1e150 || p.first > 1e100) continue;
    dual3 const set(p.first);
    vec3 const x = -p.x;
    vec3 const a = set.project(x), b = cone(p.first).project(-x);
    CHECK((a - b - x).cwiseAbs().maxCoeff() <= 4 * ε * x.cwiseAbs().maxCoeff());
    CHECK(std::abs(a.normalized().dot(b.normalized())) * std::min(a.norm(), b.norm()) <=
          8 * ε * x.norm());
    CHECK((set.slant(x) + cone(p.first).slant(-x) - Eigen::Matrix3d::Identity())
              .cwiseAbs()
              .maxCoeff() <= 8 * ε);
  }
  for (double μ : {0.0, 0.5}) {
    for (vec3 const& x : {vec3(1, 0, 0), vec3(-1, 0, 0), vec3(-4, 2, 0)}) {
      CHECK(dual3(μ).slant(x) + cone(μ).slant(-x) == Eigen::Matrix3d::Identity());
    }
  }
}

TEST_CASE("dual cone: at the apex and on the plane of a half space the value is that from inside") {
  for (vec3 const& x : {vec3(0, 0, 0), vec3(0, 3, 4)}) {
    CHECK(dual3(0.0).slant(x) == Eigen::Matrix3d::Identity());
  }
  CHECK(dual3(0.5).slant(vec3(0, 0, 0)) == Eigen::Matrix3d::Identity());
}

TEST_CASE("dual cone: laws, the half space among them") {
  slant::testing::set_options const few{.points = 24, .directions = 3};
  slant::testing::check_set_laws(slant::dual_cone<2>{2.0}, few);
  slant::testing::check_set_laws(dual3{0.3}, few);
  slant::testing::check_set_laws(dual3{0.0}, few);
}

TEST_CASE("dual cone: slanting operator against differences in 50 digits") {
  oracle::number_source<double> source(9);
  for (int i = 0; i < 60; ++i) {
    double const μ = source.positive_of_size(-1, 1);
    vec3 x = source.direction<3>();
    double const ρ = x.tail<2>().norm();
    // Away from the kinks n = μρ and n = −ρ/μ by at least a tenth of their distance.
    double const between = source.uniform(0.1, 0.9);
    x(0) = i % 3 == 0   ? μ * ρ * (1.1 + source.uniform(0, 3))
           : i % 3 == 1 ? -ρ / μ * (1.1 + source.uniform(0, 3))
                        : between * μ * ρ - (1 - between) * ρ / μ;
    auto const naive = [&](auto const& z) { return naive_project<float_50, 3>(z, float_50(μ)); };
    oracle::check_slant(dual3(μ), x, naive, 1e-15, 8);
  }
}

TEST_CASE("dual cone: state, membership, μ = 0") {
  dual3 const set(0.5), half_space(0.0);
  vec3 const on_mantle(5, 6, 8);
  CHECK(set.state(on_mantle) == block_state::sliding);
  CHECK(set.state(vec3(5 * (1 + 40 * ε), 6, 8)) == block_state::free);
  CHECK(set.contains(vec3(5 * (1 - 4 * ε), 6, 8)));
  CHECK_FALSE(set.contains(vec3(5 * (1 - 40 * ε), 6, 8)));
  CHECK_FALSE(set.contains(vec3(-1e-300, 0, 0)));
  CHECK(set.state(vec3(0, 0, 0)) == block_state::fixed);
  CHECK(half_space.project(vec3(-2, 3, 4)) == vec3(0, 3, 4));
  CHECK(half_space.project(vec3(-1e300, 1e-300, 0)) == vec3(0, 1e-300, 0));
  CHECK(half_space.state(vec3(0, 3, 4)) == block_state::sliding);
  CHECK(half_space.state(vec3(0, 0, 0)) == block_state::sliding);
  CHECK(half_space.state(vec3(1e-300, 3, 4)) == block_state::free);
  CHECK(half_space.step_to_boundary(vec3(2, 3, 4), vec3(-1, 5, 0)) == 2.0);
  CHECK(half_space.step_to_boundary(vec3(2, 3, 4), vec3(0, 5, 0)) == inf);
}

TEST_CASE("dual cone: steps agree with bisection in 50 digits at all scales") {
  using wide = Eigen::Matrix<float_50, 3, 1>;
  oracle::number_source<double> source(10);
  double worst = 0;
  for (int i = 0; i < 60; ++i) {
    double const μ = source.positive_of_size(-3, 3), n = source.positive_of_size(-130, 130);
    vec3 x(n, 0, 0);
    double const depth = i % 3 == 0   ? 4 * ε
                         : i % 3 == 1 ? source.positive_of_size(-14, 0) / 2
                                      : 0.7;
    x.tail<2>() = (1 - depth) / μ * n * source.direction<2>();
    vec3 const d = source.of_size(-3, 3) * source.direction<3>();
    float_50 const M(μ);
    auto const member = [&](wide const& z) {
      return z(0) >= 0 && M * M * (z(1) * z(1) + z(2) * z(2)) <= z(0) * z(0);
    };
    worst = std::max(worst, oracle::step_error(dual3(μ), member, x, d, n));
  }
  CHECK(worst <= 4);
}

TEST_CASE("dual cone: inequality and its derivatives") {
  using wide = Eigen::Matrix<float_50, 3, 1>;
  oracle::check_inequality_derivatives(slant::dual_cone<3, float_50>(float_50(0.75)),
                                       wide(float_50(2), float_50(-0.25), float_50(3)),
                                       float_50(1e-10));
}

TEST_CASE("dual: of a cone, of a dual, of a product") {
  auto const K = slant::power(cone{}, Eigen::Vector3d(0.5, 0, 2));
  auto const dual_of_K = slant::dual(K);
  CHECK(dual_of_K.block(2).mu() == 2.0);
  Eigen::VectorXd const x = Eigen::VectorXd::LinSpaced(9, -3, 2);
  Eigen::VectorXd const a = slant::project(dual_of_K, x), b = slant::project(K, (-x).eval());
  CHECK((a - b - x).norm() <= 4 * ε * x.norm());
  CHECK(slant::project(slant::dual(dual_of_K), x) == slant::project(K, x));
  slant::testing::check_set_laws(dual_of_K,
                                 slant::testing::set_options{.points = 12, .directions = 2});
}

TEST_CASE("dual cone: NaN stays NaN, bad input is named") {
  for (double μ : {0.0, 1.0}) {
    dual3 const set(μ);
    for (vec3 const& bad : {vec3(quiet_nan, 1, 0), vec3(1, quiet_nan, 0)}) {
      CHECK(set.project(bad).array().isNaN().all());
      CHECK(set.slant(bad).array().isNaN().all());
      CHECK_FALSE(set.contains(bad));
      CHECK(std::isnan(set.step_to_boundary(bad, vec3(-1, 0, 0))));
      CHECK(std::isnan(set.support(bad)));
    }
  }
  CHECK(oracle::complaint<slant::bad_input>([] { return dual3(-1.0); }) ==
        "mu: got -1, expected a finite number >= 0");
}

}  // namespace dual_cone_test
