// SPDX-License-Identifier: MIT
#include <slant/contact/friction/friction_interior_point.hpp>

#include <Eigen/Dense>

#include <doctest/doctest.h>

#include <cmath>
#include <random>

namespace lorentz_scaling_test {

using real = long double;
template <int N>
using algebra = slant::contact::detail::lorentz<N, double>;
template <int N>
using scaling = slant::contact::detail::lorentz_scaling<N, double>;
template <int N>
using wide = Eigen::Matrix<real, N, 1>;
template <int N>
using wide_block = Eigen::Matrix<real, N, N>;

template <int N>
real naive_determinant(wide<N> const& x) {
  return x[0] * x[0] - x.template tail<N - 1>().squaredNorm();
}
template <int N>
wide_block<N> signs() {
  wide_block<N> J = -wide_block<N>::Identity();
  J(0, 0) = 1;
  return J;
}
/// TᵀT of x and s: the symmetric matrix η (2 w wᵀ − J), det w = 1, that takes x to s.
template <int N>
wide_block<N> naive_scaling(wide<N> const& x, wide<N> const& s) {
  real const X = std::sqrt(naive_determinant<N>(x)), S = std::sqrt(naive_determinant<N>(s));
  wide<N> const x1 = x / X, s1 = s / S;
  wide<N> const w = (s1 + signs<N>() * x1) / std::sqrt(2 + 2 * x1.dot(s1));
  return S / X * (2 * w * w.transpose() - signs<N>());
}
template <int N>
wide_block<N> T_of(scaling<N> const& p) {
  return (p.U() * p.Σ().asDiagonal() * p.V().transpose()).template cast<real>();
}
template <int N>
double largest(wide_block<N> const& m) {
  return double(m.cwiseAbs().maxCoeff());
}

template <int N>
void check_laws(scaling<N> const& p, double tolerance) {
  auto const J = signs<N>(), one = wide_block<N>(wide_block<N>::Identity());
  auto const T = T_of<N>(p);
  wide<N> const x = p.x().template cast<real>(), s = p.s().template cast<real>();
  wide<N> const λ = p.λ().template cast<real>();
  CHECK(λ[0] > λ.template tail<N - 1>().norm());
  CHECK(double((T * x - λ).norm()) <= tolerance * double(T.norm() * x.norm()));
  CHECK(double((T.transpose() * λ - s).norm()) <= tolerance * double(T.norm() * λ.norm()));
  CHECK(std::abs(double(x.dot(s) / λ.squaredNorm()) - 1) <= tolerance);
  // T is of the group of L: T J Tᵀ = η J, with η² the ratio of the determinants of s and x.
  auto const η = std::pow(T.determinant(), real(2) / N);
  auto const U = wide_block<N>(p.U().template cast<real>());
  auto const V = wide_block<N>(p.V().template cast<real>());
  CHECK(largest<N>(T * J * T.transpose() - η * J) <= tolerance * double(T.squaredNorm()));
  CHECK(largest<N>(U.transpose() * U - one) <= 1e-15);
  CHECK(largest<N>(V.transpose() * V - one) <= 1e-15);
  CHECK(p.Σ()[0] * p.Σ()[1] == doctest::Approx(double(η)).epsilon(tolerance));
}

template <int N>
void check_steps() {
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  using part = typename scaling<N>::part;
  for (int k = 0; k < 40; ++k) {
    scaling<N> p(std::exp(3 * normal(random)), std::exp(3 * normal(random)));
    for (int step = 0; step < 4; ++step) {
      part const dx = part::NullaryExpr([&](auto) { return normal(random); });
      part const ds = part::NullaryExpr([&](auto) { return normal(random); });
      double const t = std::min(1., 0.7 * p.length(dx, ds));
      auto const T = T_of<N>(p);
      wide<N> const x =
          p.x().template cast<real>() + T.inverse() * wide<N>((t * dx).template cast<real>());
      wide<N> const s =
          p.s().template cast<real>() + T.transpose() * wide<N>((t * ds).template cast<real>());
      p.move(t * dx, t * ds);
      CHECK(double((p.x().template cast<real>() - x).norm() / x.norm()) <= 1e-12);
      CHECK(double((p.s().template cast<real>() - s).norm() / s.norm()) <= 1e-12);
      auto const M = naive_scaling<N>(x, s);
      auto const G = T_of<N>(p);
      CHECK(largest<N>(G.transpose() * G - M) <= 1e-11 * largest<N>(M));
      CHECK(double((M * x - s).norm()) <= 1e-14 * double(M.norm() * x.norm()));
      check_laws<N>(p, 1e-12);
    }
  }
}

TEST_CASE("lorentz scaling: steps, laws and TᵀT against the closed form in long double") {
  check_steps<2>();
  check_steps<3>();
}

TEST_CASE("lorentz scaling: at a multiple of the unit, at any scale") {
  for (double const scale : {1e-100, 1., 1e100}) {
    scaling<3> const p(4 * scale, 9 * scale);
    CHECK((p.λ() - 6 * scale * Eigen::Vector3d::UnitX()).norm() <= 1e-15 * scale * 6);
    CHECK((p.x() - 4 * scale * Eigen::Vector3d::UnitX()).norm() <= 1e-15 * scale * 4);
    CHECK((p.s() - 9 * scale * Eigen::Vector3d::UnitX()).norm() <= 1e-15 * scale * 9);
    CHECK((p.Σ() - Eigen::Vector3d::Constant(1.5)).norm() <= 1e-15);
    CHECK(p.x().tail<2>() == Eigen::Vector2d::Zero());
    // 6 of them down the axis, and no end up.
    Eigen::Vector3d const up = scale * Eigen::Vector3d::UnitX();
    CHECK(p.length(-up, up) == doctest::Approx(6).epsilon(1e-14));
    CHECK(std::isinf(p.length(up, up)));
  }
}

TEST_CASE("lorentz scaling: x and s go to opposite sides of the boundary, and λ stays inside") {
  scaling<3> p(1, 1);
  Eigen::Vector3d const ray(1, 0.6, 0.8), opposite(1, -0.6, -0.8);
  for (int k = 0; k < 30; ++k) {  // what is left of x is along one ray, of s along the other
    Eigen::Vector3d const dx = 0.1 * ray - 0.9 * p.λ(), ds = 0.1 * opposite - 0.9 * p.λ();
    double const t = std::min(1., 0.9 * p.length(dx, ds));
    p.move(t * dx, t * ds);
    // x and s as vectors have lost their digits by now; what T is made of has not.
    CHECK(p.λ()[0] > 1.01 * p.λ().tail<2>().norm());
    CHECK((p.U().transpose() * p.U() - Eigen::Matrix3d::Identity()).norm() <= 1e-15);
    CHECK((p.V().transpose() * p.V() - Eigen::Matrix3d::Identity()).norm() <= 1e-15);
    CHECK(p.Σ()[0] * p.Σ()[1] == doctest::Approx(p.Σ()[2] * p.Σ()[2]).epsilon(1e-14));
  }
  CHECK(p.Σ()[0] > 1e6 * p.Σ()[1]);
  CHECK(p.x().allFinite());
}

template <int N>
void check_algebra() {
  std::mt19937 random(6);
  std::normal_distribution<double> normal;
  using part = typename scaling<N>::part;
  auto const number = [&](auto) { return normal(random); };
  part e = part::Zero();
  e[0] = 1;
  for (int k = 0; k < 50; ++k) {
    part x = part::NullaryExpr(number), y = part::NullaryExpr(number);
    x[0] = x.template tail<N - 1>().norm() + std::abs(x[0]) + 0.1;  // inside
    part const xy = algebra<N>::product(x, y);
    CHECK((xy - algebra<N>::product(y, x)).norm() <= 1e-15 * xy.norm());
    CHECK((algebra<N>::product(x, e) - x).norm() <= 1e-15 * x.norm());
    CHECK((algebra<N>::quotient(xy, x) - y).norm() <= 1e-11 * (1 + y.norm()));
    auto const d = naive_determinant<N>(x.template cast<real>());
    CHECK(algebra<N>::determinant(x) == doctest::Approx(double(d)).epsilon(1e-14));
    // x ∘ J x = det(x) e.
    CHECK((algebra<N>::product(x, algebra<N>::reflected(x)) - double(d) * e).norm() <=
          1e-14 * x.squaredNorm());
    // 2 v vᵀ − J keeps determinants if det v = 1, and is symmetric.
    part const v = x / std::sqrt(algebra<N>::determinant(x));
    auto const H = algebra<N>::hyperbolic(v);
    CHECK(H == H.transpose());
    CHECK(std::abs(algebra<N>::determinant(part(H * y)) - algebra<N>::determinant(y)) <=
          1e-13 * H.squaredNorm() * y.squaredNorm());
  }
}

TEST_CASE("lorentz algebra: unit, inverse, determinant, hyperbolic reflections") {
  check_algebra<2>();
  check_algebra<3>();
}

}  // namespace lorentz_scaling_test
