// SPDX-License-Identifier: MIT
#include "slanting_support.hpp"

#include "oracle/hard_points.hpp"
#include "oracle/precise.hpp"
#include "oracle/set_checks.hpp"

#include <slant/slanting/affine.hpp>
#include <slant/slanting/arithmetic.hpp>
#include <slant/slanting/de_saxce.hpp>
#include <slant/slanting/fischer_burmeister_cone.hpp>
#include <slant/testing/slanting_laws.hpp>

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <cmath>
#include <limits>

namespace fischer_burmeister_cone_test {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using oracle::float_50;
using slanting_support::dense_slant;
using slanting_support::random_vector;
using kernel = slant::detail::friction_fischer_burmeister<3, double>;
using wide = Eigen::Matrix<float_50, 3, 1>;

constexpr double ε = std::numeric_limits<double>::epsilon();

/// Φ in many digits, by the eigenvalues of x² + y².
template <class Real>
Eigen::Matrix<Real, 3, 1> naive(Real const& μ, Eigen::Matrix<Real, 3, 1> const& r,
                                Eigen::Matrix<Real, 3, 1> const& u) {
  using vector = Eigen::Matrix<Real, 3, 1>;
  vector const x(r(0), r(1) / μ, r(2) / μ), y(u(0), μ * u(1), μ * u(2));
  Real const w0 = x.dot(x) + y.dot(y);
  Real const a = 2 * (x(0) * x(1) + y(0) * y(1)), b = 2 * (x(0) * x(2) + y(0) * y(2));
  Real const length = sqrt(Real(a * a + b * b));
  Real const rest = w0 - length;
  Real const larger = sqrt(Real(w0 + length)), smaller = rest > 0 ? sqrt(rest) : Real(0);
  Real const slope = length > 0 ? Real((larger - smaller) / (2 * length)) : Real(0);
  vector φ = x + y - vector((larger + smaller) / 2, slope * a, slope * b);
  φ(1) *= μ;
  φ(2) *= μ;
  return φ;
}

TEST_CASE("Fischer–Burmeister of cones: complementary pairs are zeros, others are none") {
  kernel const Φ = kernel().with(0.5);
  CHECK(Φ.value(Vector3d(2, 0.5, 0), Vector3d(0, 0, 0)).norm() <= ε);       // stick
  CHECK(Φ.value(Vector3d(0, 0, 0), Vector3d(2, 1, -1)).norm() <= ε);        // open
  CHECK(Φ.value(Vector3d(2, -1, 0), Vector3d(1.5, 3, 0)).norm() <= 4 * ε);  // slip: û_n = μ‖û_t‖
  CHECK(Φ.value(Vector3d(2, -1, 0), Vector3d(1.5, 0, 3)).norm() > 0.1);
  CHECK(Φ.value(Vector3d(-1, 0, 0), Vector3d(0, 0, 0)) == Vector3d(-2, 0, 0));
  kernel const smooth = kernel().with(0.0);
  CHECK((smooth.value(Vector3d(3, 7, 8), Vector3d(4, 5, 6)) - Vector3d(2, 7, 8)).norm() <= 4 * ε);
  CHECK(Φ.value(Vector3d(std::nan(""), 0, 0), Vector3d(0, 0, 0)).hasNaN());
  CHECK(Φ.slants(Vector3d(1, 0, 0), Vector3d(0, std::nan(""), 0)).first.hasNaN());
}

TEST_CASE("Fischer–Burmeister of cones: values and slopes against 50 digits, at all scales") {
  oracle::number_source<double> source(1);
  double value_error = 0, slope_error = 0;
  for (int i = 0; i < 120; ++i) {
    double const μ = source.positive_of_size(-1, 1), scale = source.positive_of_size(-150, 150);
    Vector3d r = source.of_size(-2, 2) * source.direction<3>();
    Vector3d u = source.of_size(-2, 2) * source.direction<3>();
    if (i % 3 == 1) {  // nearly complementary by sliding
      Eigen::Vector2d const e = source.direction<2>();
      double const n = source.positive_of_size(-1, 1), slip = source.positive_of_size(-1, 1);
      r << n, μ * n * e;
      u << μ * slip, -slip * e;
      r += source.of_size(-14, -3) * source.direction<3>();
    }
    kernel const Φ = kernel().with(μ);
    r *= scale;
    u *= scale;
    auto const exact =
        naive<float_50>(float_50(μ), oracle::widen<float_50>(r), oracle::widen<float_50>(u));
    auto const computed = Φ.value(r, u);
    // x = D r and y = D⁻¹ û are rounded once, φ has slopes up to 2, and Φ_t = μ φ_t.
    double const size = (1 + μ) * (r.norm() * (1 + 1 / μ) + u.norm() * (1 + μ));
    for (int k = 0; k < 3; ++k) {
      value_error = std::max(value_error, double(abs(float_50(computed(k)) - exact(k))) / size);
    }
    auto const [P, Q] = Φ.slants(r, u);
    float_50 const h = float_50(1e-20) * float_50(scale);
    auto const at_r = oracle::differences<float_50, 3, 3>(
        [&](wide const& z) { return naive<float_50>(float_50(μ), z, oracle::widen<float_50>(u)); },
        oracle::widen<float_50>(r), h);
    auto const at_u = oracle::differences<float_50, 3, 3>(
        [&](wide const& z) { return naive<float_50>(float_50(μ), oracle::widen<float_50>(r), z); },
        oracle::widen<float_50>(u), h);
    double const unit = 1 + 1 / μ + μ * μ;
    for (int k = 0; k < 9; ++k) {
      double const p = double(abs(float_50(P(k / 3, k % 3)) - at_r(k / 3, k % 3)));
      double const q = double(abs(float_50(Q(k / 3, k % 3)) - at_u(k / 3, k % 3)));
      slope_error = std::max({slope_error, p / unit, q / unit});
    }
  }
  CHECK(value_error <= 2 * ε);
  CHECK(slope_error <= 64 * ε);
}

TEST_CASE(
    "Fischer–Burmeister of cones: any coefficient; nothing overflows that the result does not") {
  // Far outside of the cone the root is (‖x_t‖, x_n e): Φ = (r_n − ‖r_t‖/μ, r_t) to all digits.
  for (double μ : {1e-20, 1e-200, 1e-290}) {
    Vector3d const f = kernel().with(μ).value(Vector3d(1, 1e10, 0), Vector3d(0, 0, 0));
    CHECK(f(0) == doctest::Approx(-1e10 / μ).epsilon(1e-14));
    CHECK(f(1) == doctest::Approx(1e10).epsilon(1e-14));
  }
  Vector3d const f = kernel().with(1e-300).value(Vector3d(1, 1e10, 0), Vector3d(0, 0, 0));
  CHECK(f(0) == -std::numeric_limits<double>::infinity());
  CHECK(f(1) == doctest::Approx(1e10).epsilon(1e-14));
  CHECK(kernel().with(1e300).value(Vector3d(0, 0, 0), Vector3d(1, -1e-320, 0)).allFinite());
}

TEST_CASE("Fischer–Burmeister of cones: slope at the kinks is the limit along (x + τ, y + τ)") {
  using jordan = slant::detail::jordan_fischer_burmeister<double, 3>;
  Vector3d const e0(1, 0, 0);
  for (Vector3d const& x : {Vector3d(0, 0, 0), Vector3d(5, 3, 4), Vector3d(-5, -3, -4)}) {
    for (double c : {0.0, 2.0}) {
      Vector3d const y = c * x;
      auto const [P, Q] = jordan(x, y).slants();
      double const τ = 1e-6;
      auto const [P1, Q1] = jordan(x + τ * e0, y + τ * e0).slants();
      CHECK((P - P1).norm() <= 1e-5);
      CHECK((Q - Q1).norm() <= 1e-5);
    }
  }
}

TEST_CASE("Fischer–Burmeister of cones: limits at stick, slip, opening, the apex and on the axis") {
  auto const both = [](double μ) {
    MatrixXd const r = MatrixXd::Identity(3, 6), u = MatrixXd::Identity(6, 6).bottomRows(3);
    return slant::fischer_burmeister_cone<3>(VectorXd{{μ}}, slant::linear(MatrixXd(r)),
                                             slant::linear(MatrixXd(u)));
  };
  auto const f = both(0.5);
  slant::testing::check_slanting_laws(
      f, VectorXd(VectorXd::Zero(6)), VectorXd{{2.0, 0.5, 0.0, 0.0, 0.0, 0.0}},
      VectorXd{{0.0, 0.0, 0.0, 2.0, 1.0, -1.0}}, VectorXd{{2.0, -1.0, 0.0, 1.5, 3.0, 0.0}});
  slant::testing::check_slanting_laws(f, VectorXd{{10.0, 3.0, 4.0, 0.0, 0.0, 0.0}},
                                      VectorXd{{0.0, 0.0, 0.0, 2.5, 3.0, 4.0}},
                                      VectorXd{{1.0, 0.0, 0.0, 3.0, 0.0, 0.0}});
  slant::testing::check_slanting_laws(both(0.0), VectorXd(VectorXd::Zero(6)),
                                      VectorXd{{1.0, 1.0, 0.0, 0.0, 2.0, 0.0}});
}

TEST_CASE(
    "Fischer–Burmeister of cones: Coulomb friction by composition, chain rule, no allocation") {
  slant::index const n = 12;
  MatrixXd const W = slanting_support::random_spd(n, 3);
  VectorXd const q = random_vector(n, 4), mu{{0.3, 1.0, 0.0, 0.6}};
  auto const velocity = slant::positive(0.5) * (slant::de_saxce<3>(mu) * slant::affine(W, q));
  auto const F = slant::fischer_burmeister_cone<3>(mu, slant::identity_map(n), velocity);
  VectorXd const r = 3 * random_vector(n, 5);
  VectorXd const u = slant::evaluate(velocity, r), f = slant::evaluate(F, r);
  MatrixXd const H = dense_slant(velocity, r), G = dense_slant(F, r);
  for (int i = 0; i < 4; ++i) {
    kernel const Φ = kernel().with(mu[i]);
    Vector3d const ri = r.segment<3>(3 * i), ui = u.segment<3>(3 * i);
    CHECK(f.segment<3>(3 * i) == Φ.value(ri, ui));
    auto const [P, Q] = Φ.slants(ri, ui);
    MatrixXd expected = Q * H.middleRows<3>(3 * i);
    expected.middleCols<3>(3 * i) += P;
    CHECK((G.middleRows<3>(3 * i) - expected).norm() <= 1e-14 * expected.norm());
  }
  slant::testing::check_slanting_laws(F, r);
  MatrixXd columns(n, n);
  F.slant(r).columns(0, columns);
  CHECK((columns - G).norm() <= 1e-14 * G.norm());
  slanting_support::check_renewal(F, r);
}

TEST_CASE("Fischer–Burmeister of cones: orthotropic friction, one direction perhaps without any") {
  kernel const round = kernel().with(0.5), same = kernel().with(0.5, 0.5);
  Vector3d const a(1, 2, -3), b(0.5, -1, 4);
  CHECK(same.value(a, b) == round.value(a, b));
  kernel const Φ = kernel().with(2.0, 0.5);
  // r on the mantle at (cos, sin) = (0.6, 0.8), û on the mantle of the dual, opposite to it.
  Vector3d const r(1, 1.2, 0.4), u(3, -0.9, -4.8);
  CHECK(Φ.value(r, u).norm() <= 4 * ε);
  CHECK(Φ.value(r, Vector3d(3, -4.8, -0.9)).norm() > 0.1);
  kernel const half = kernel().with(2.0, 0.0);
  Vector3d const f = half.value(a, b);
  CHECK(f(2) == a(2));
  slant::detail::jordan_fischer_burmeister<double, 2> const plane({a(0), a(1) / 2},
                                                                  {b(0), 2 * b(1)});
  CHECK((f.head<2>() - Eigen::Vector2d(plane.value()(0), 2 * plane.value()(1))).norm() <= 4 * ε);
  MatrixXd const at_r = MatrixXd::Identity(3, 6), at_u = MatrixXd::Identity(6, 6).bottomRows(3);
  auto const F = slant::fischer_burmeister_cone(VectorXd{{2.0}}, VectorXd{{0.0}},
                                                slant::linear(at_r), slant::linear(at_u));
  slant::testing::check_slanting_laws(F, VectorXd{{1.0, 2.0, -3.0, 0.5, -1.0, 4.0}});
}

TEST_CASE("Fischer–Burmeister of cones: in the plane it is that of space in a plane") {
  slant::detail::friction_fischer_burmeister<2, double> const plane = {};
  oracle::number_source<double> source(5);
  for (int i = 0; i < 40; ++i) {
    double const μ = source.positive_of_size(-1, 1);
    Eigen::Vector2d const r = source.direction<2>(), u = source.direction<2>();
    Vector3d const r3(r(0), r(1), 0), u3(u(0), u(1), 0);
    kernel const space = kernel().with(μ);
    auto const flat = plane.with(μ);
    CHECK((space.value(r3, u3).head<2>() - flat.value(r, u)).norm() <=
          8 * ε * (1 + μ) * (1 + 1 / μ));
    auto const [P, Q] = flat.slants(r, u);
    auto const [P3, Q3] = space.slants(r3, u3);
    CHECK((P3.topLeftCorner<2, 2>() - P).norm() <= 64 * ε * (1 + μ + 1 / μ));
    CHECK((Q3.topLeftCorner<2, 2>() - Q).norm() <= 64 * ε * (1 + μ) * (1 + μ));
  }
}

TEST_CASE("Fischer–Burmeister of cones: bad input is named") {
  auto const made = [](double μ, slant::index n) {
    return oracle::complaint<slant::bad_input>([=] {
      return slant::fischer_burmeister_cone<3>(VectorXd{{0.5, μ}}, slant::identity_map(n),
                                               slant::identity_map(n));
    });
  };
  CHECK(made(0.1, 6).empty());
  CHECK(made(-1, 6) == "mu[1]: got -1, expected a finite number >= 0");
  CHECK_FALSE(made(0.1, 9).empty());
}

}  // namespace fischer_burmeister_cone_test
