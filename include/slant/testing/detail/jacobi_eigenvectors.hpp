// SPDX-License-Identifier: MIT
//
// Eigenvectors of a small symmetric matrix by Jacobi's rotations: for any scalar, and quick to
// compile (Eigen's solver alone would take longer than all law checks together).
#pragma once

#include <slant/concepts/scalar.hpp>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace slant::testing::detail {

/// A square matrix of finite numbers, by rows.
template <class S>
struct small_matrix {
  index size = 0;
  std::vector<S> entries;

  explicit small_matrix(index n) : size(n), entries(static_cast<std::size_t>(n * n), S(0)) {}
  S& operator()(index i, index j) { return entries[static_cast<std::size_t>(i * size + j)]; }
  S const& operator()(index i, index j) const {
    return entries[static_cast<std::size_t>(i * size + j)];
  }
};

/// Diagonalises the symmetric matrix t in place; the rows of the result are its eigenvectors, in
/// the order of the diagonal.
template <class S>
[[nodiscard]] small_matrix<S> jacobi_eigenvectors(small_matrix<S>& t) {
  using std::abs;
  using std::sqrt;
  index const n = t.size;
  small_matrix<S> vectors(n);
  for (index i = 0; i < n; ++i) vectors(i, i) = S(1);
  S const ε = std::numeric_limits<S>::epsilon();
  S size(0);
  for (S const& entry : t.entries) {
    S const magnitude = abs(entry);
    if (magnitude > size) size = magnitude;
  }
  bool rotated = true;
  for (int sweep = 0; rotated && sweep < 60; ++sweep) {
    rotated = false;
    for (index p = 0; p < n; ++p) {
      for (index q = p + 1; q < n; ++q) {
        S const off = t(p, q);
        if (!(S(abs(off)) > ε * size)) continue;
        rotated = true;
        // The rotation by the smaller angle that annihilates t(p, q).
        S const θ = (t(q, q) - t(p, p)) / (S(2) * off);
        S const tangent = (θ < S(0) ? S(-1) : S(1)) / (S(abs(θ)) + S(sqrt(S(θ * θ + S(1)))));
        S const c = S(1) / S(sqrt(S(tangent * tangent + S(1))));
        S const s = tangent * c;
        auto const rotate = [&](S& a, S& b) {
          S const old = a;
          a = c * old - s * b;
          b = s * old + c * b;
        };
        for (index k = 0; k < n; ++k) rotate(t(k, p), t(k, q));
        for (index k = 0; k < n; ++k) rotate(t(p, k), t(q, k));
        for (index k = 0; k < n; ++k) rotate(vectors(p, k), vectors(q, k));
      }
    }
  }
  return vectors;
}

}  // namespace slant::testing::detail
