// SPDX-License-Identifier: MIT
//
// The extreme eigenvalues of a small symmetric tridiagonal matrix, by bisection on its Sturm
// sequence [Barth, Martin, Wilkinson 1967]: λ exceeds all eigenvalues if and only if all pivots of
// the LDLᵀ factorisation of T − λ I are negative. Backward stable in any scalar, and the bound errs
// on the safe side: the upper end of the last interval is returned.
#pragma once

#include <slant/concepts/scalar.hpp>

#include <algorithm>
#include <limits>
#include <vector>

namespace slant::detail {

/// Are all eigenvalues of the matrix with diagonal a and off-diagonal b smaller than λ?
template <class S>
[[nodiscard]] bool all_eigenvalues_below(S const& λ, std::vector<S> const& a,
                                         std::vector<S> const& b) {
  S pivot = a[0] - λ;
  for (std::size_t i = 1; pivot < S(0) && i < a.size(); ++i) {
    pivot = a[i] - λ - b[i - 1] * (b[i - 1] / pivot);
  }
  return pivot < S(0);
}

/// Largest eigenvalue of the matrix with diagonal a (n ≥ 1 entries) and off-diagonal b (n − 1
/// entries), to a few ε of the largest entry, never too small by more than the rounding of T.
template <class S>
[[nodiscard]] S largest_tridiagonal_eigenvalue(std::vector<S> const& a, std::vector<S> const& b) {
  using std::abs;
  S lower = a[0], upper = a[0], size(0);  // λ_max is at least a_ii and at most Gershgorin's bound
  for (std::size_t i = 0; i < a.size(); ++i) {
    S radius(0);
    if (i > 0) radius += abs(b[i - 1]);
    if (i + 1 < a.size()) radius += abs(b[i]);
    lower = std::max<S>(lower, a[i]);
    upper = std::max<S>(upper, S(a[i] + radius));
    size = std::max<S>(size, S(abs(a[i]) + radius));
  }
  S const resolution = std::numeric_limits<S>::epsilon() * size;
  while (upper - lower > resolution) {
    S const middle = lower + (upper - lower) / S(2);
    if (!(lower < middle && middle < upper)) break;
    (all_eigenvalues_below(middle, a, b) ? upper : lower) = middle;
  }
  return upper;
}

/// Smallest eigenvalue of the same matrix, never too large by more than the rounding of T.
template <class S>
[[nodiscard]] S smallest_tridiagonal_eigenvalue(std::vector<S> a, std::vector<S> const& b) {
  for (auto& e : a) e = -e;  // −T has the off-diagonal −b, whose signs change no eigenvalue
  return -largest_tridiagonal_eigenvalue(a, b);
}

}  // namespace slant::detail
