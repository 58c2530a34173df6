// SPDX-License-Identifier: MIT
//
// Checks that every set passes: derivatives against differences in 50 digits, the optimality
// conditions of a projection, and steps to the boundary against bisection.
#pragma once

#include <doctest/doctest.h>

#include "precise.hpp"

#include <Eigen/Core>

#include <string>
#include <utility>

namespace oracle {

/// Jacobian of f: R^N → R^M at x by central differences with step h.
template <class Real, int M, int N, class F>
Eigen::Matrix<Real, M, N> differences(F const& f, Eigen::Matrix<Real, N, 1> const& x,
                                      Real const& h) {
  Eigen::Matrix<Real, M, N> J;
  for (int j = 0; j < N; ++j) {
    Eigen::Matrix<Real, N, 1> forward = x, backward = x;
    forward(j) += h;
    backward(j) -= h;
    Eigen::Matrix<Real, M, 1> const above = f(forward), below = f(backward);
    J.col(j) = (above - below) / (Real(2) * h);
  }
  return J;
}

/// slant(x), computed in S, equals the derivative of the naive projection within `tolerance` times
/// epsilon, is symmetric and between 0 and I. x lies off the kinks by much more than `h`.
template <class Set, class Project>
void check_slant(Set const& set, typename Set::vector_type const& x, Project const& naive_project,
                 double h, double tolerance) {
  using S = typename Set::scalar;
  constexpr int N = Set::dimension;
  double const accuracy = tolerance * static_cast<double>(std::numeric_limits<S>::epsilon());
  auto const G = set.slant(x);
  auto const exact = differences<float_50, N, N>(naive_project, widen<float_50>(x), float_50(h));
  for (int i = 0; i < N; ++i) {
    for (int j = 0; j < N; ++j) {
      CHECK(static_cast<double>(abs(float_50(G(i, j)) - exact(i, j))) <= accuracy);
      CHECK(G(i, j) == G(j, i));
    }
  }
  // 0 ⪯ G ⪯ I: ‖Gv‖² <= vᵀGv is both at once for a symmetric G.
  for (int k = 0; k < N + 2; ++k) {
    Eigen::Matrix<float_50, N, 1> v = Eigen::Matrix<float_50, N, 1>::Ones();
    if (k < N) v(k) = float_50(-2);
    if (k == N) v = widen<float_50>(x) / widen<float_50>(x).norm();
    Eigen::Matrix<float_50, N, 1> Gv = Eigen::Matrix<float_50, N, 1>::Zero();
    for (int i = 0; i < N; ++i) {
      for (int j = 0; j < N; ++j) Gv(i) += float_50(G(i, j)) * v(j);
    }
    CHECK(Gv.squaredNorm() - v.dot(Gv) <= float_50(accuracy) * v.squaredNorm());
  }
}

/// p = project(x) is in the set and x − p is normal there: (x − p)ᵀz <= (x − p)ᵀp for all z of the
/// set, which says support(x − p) = (x − p)ᵀp. For an infinite support the candidates are `points`.
template <class Set, class Points>
void check_variational_inequality(Set const& set, typename Set::vector_type const& x,
                                  Points const& points, double tolerance = 8) {
  using S = typename Set::scalar;
  auto const p = set.project(x);
  CHECK(set.contains(p));
  auto const wide_p = widen<float_50>(p);
  auto const normal = (widen<float_50>(x) - wide_p).eval();
  float_50 const rounding = float_50(tolerance) * float_50(std::numeric_limits<S>::epsilon());
  for (auto const& z : points) {
    auto const to_z = (widen<float_50>(z) - wide_p).eval();
    float_50 const size =
        sqrt(normal.squaredNorm()) * (sqrt(to_z.squaredNorm()) + sqrt(wide_p.squaredNorm()));
    CHECK(normal.dot(to_z) <= rounding * size);
  }
}

/// The gradient and the Hessian of the inequality form of a set over float_50.
template <class Set>
void check_inequality_derivatives(Set const& set, typename Set::vector_type const& x,
                                  float_50 const& h) {
  static_assert(std::is_same_v<typename Set::scalar, float_50>);
  constexpr int N = Set::dimension;
  constexpr int M = Set::inequalities;
  auto const value = [&](auto const& z) { return set.inequality(z); };
  Eigen::Matrix<float_50, M, N> const J = differences<float_50, M, N>(value, x, h);
  Eigen::Matrix<float_50, N, M> const gradient = set.inequality_gradient(x);
  float_50 const scale = gradient.cwiseAbs().maxCoeff();
  CHECK((J.transpose() - gradient).cwiseAbs().maxCoeff() <= float_50(1e-20) * scale);

  Eigen::Matrix<float_50, M, 1> ν;
  for (int i = 0; i < M; ++i) ν(i) = float_50(3) / float_50(i + 2);
  auto const weighted = [&](auto const& z) {
    return Eigen::Matrix<float_50, N, 1>(set.inequality_gradient(z) * ν);
  };
  Eigen::Matrix<float_50, N, N> const H = differences<float_50, N, N>(weighted, x, h);
  Eigen::Matrix<float_50, N, N> const hessian = set.inequality_hessian(x, ν);
  CHECK((H - hessian).cwiseAbs().maxCoeff() <=
        float_50(1e-20) * (float_50(1) + hessian.cwiseAbs().maxCoeff()));
}

/// what() of the bad_input that `make` throws, empty if it throws nothing.
template <class Error, class Make>
std::string complaint(Make const& make) {
  try {
    static_cast<void>(make());
  } catch (Error const& error) {
    return error.what();
  }
  return {};
}

}  // namespace oracle
