// SPDX-License-Identifier: MIT
//
// What tests of sets share: the slanting operator against differences in 50 digits.
#pragma once

#include <support/testing.hpp>
#include "precise.hpp"

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
    for (int i = 0; i < N; ++i)
      for (int j = 0; j < N; ++j) Gv(i) += float_50(G(i, j)) * v(j);
    CHECK(Gv.squaredNorm() - v.dot(Gv) <= float_50(accuracy) * v.squaredNorm());
  }
}

}  // namespace oracle
