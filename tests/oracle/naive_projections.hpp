// SPDX-License-Identifier: MIT
//
// Projections as a textbook states them, with no care for rounding or range: the twins that the
// sets of the library are compared with. Run in a wider type than the one under test they are
// oracles.
#pragma once

#include <Eigen/Core>

#include <cmath>

namespace naive {

template <class Real, int N>
Eigen::Matrix<Real, N, 1> project_box(Eigen::Matrix<Real, N, 1> x, Real const& l, Real const& u) {
  using std::max;
  using std::min;
  for (int i = 0; i < N; ++i) x(i) = min(u, max(l, x(i)));
  return x;
}

/// x min(1, g/‖x‖).
template <class Real, int N>
Eigen::Matrix<Real, N, 1> project_ball(Eigen::Matrix<Real, N, 1> const& x, Real const& g) {
  using std::sqrt;
  Real squares(0);
  for (int i = 0; i < N; ++i) squares += x(i) * x(i);
  if (squares <= g * g) return x;
  return (g / Real(sqrt(squares))) * x;
}

/// The three cases of the cone ‖x_t‖ <= μ x_n.
template <class Real, int N>
Eigen::Matrix<Real, N, 1> project_cone(Eigen::Matrix<Real, N, 1> const& x, Real const& μ) {
  using std::sqrt;
  Real squares(0);
  for (int i = 1; i < N; ++i) squares += x(i) * x(i);
  Real const ρ = sqrt(squares);
  if (x(0) >= Real(0) && ρ <= μ * x(0)) return x;
  if (x(0) + μ * ρ <= Real(0)) return Eigen::Matrix<Real, N, 1>::Zero();
  Real const n = (x(0) + μ * ρ) / (Real(1) + μ * μ);
  Eigen::Matrix<Real, N, 1> p = (μ * n / ρ) * x;
  p(0) = n;
  return p;
}

/// (ax/(a² + t))² + (by/(b² + t))² − 1, the secular equation for the multiplier t.
template <class Real>
Real ellipse_secular(Real const& a, Real const& b, Real const& x, Real const& y, Real const& t) {
  Real const X = a * x / (a * a + t);
  Real const Y = b * y / (b * b + t);
  return X * X + Y * Y - Real(1);
}

/// Its root by bisection, t in [0, a‖x‖ + …], until the bracket cannot be halved.
template <class Real>
Real ellipse_multiplier(Real const& a, Real const& b, Real x, Real y) {
  using std::abs;
  x = abs(x);
  y = abs(y);
  if (ellipse_secular(a, b, x, y, Real(0)) <= Real(0)) return Real(0);
  Real lower(0), upper = Real(2) * (a * x + b * y);  // there each term is at most 1/4
  for (;;) {
    Real const middle = (lower + upper) / Real(2);
    if (!(middle > lower && middle < upper)) return middle;
    (ellipse_secular(a, b, x, y, middle) > Real(0) ? lower : upper) = middle;
  }
}

/// Largest α with member(x + α d), member(x) given, by doubling and bisection; negative if the ray
/// stays inside up to α = `longest`.
template <class Real, class Member, class Vector>
Real exit_step(Member const& member, Vector const& x, Vector const& d, Real const& longest) {
  Real lower(0), upper = Real(1) / longest;
  while (member(Vector(x + upper * d))) {
    lower = upper;
    upper *= Real(2);
    if (upper > longest) return Real(-1);
  }
  for (;;) {
    Real const middle = (lower + upper) / Real(2);
    if (!(middle > lower && middle < upper)) return middle;
    (member(Vector(x + middle * d)) ? lower : upper) = middle;
  }
}

}  // namespace naive
