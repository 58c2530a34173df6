// SPDX-License-Identifier: MIT
//
// Eigenvalues and eigenvectors of a symmetric matrix of fixed size by Jacobi's rotations: accurate
// to the last digits of each eigenvalue where Eigen's solver is so only to those of the largest,
// for any scalar, and quick to compile. One rotation does all for 2 × 2.
#pragma once

#include <Eigen/Core>

#include <limits>

namespace slant::detail {

/// G = V diag(values) Vᵀ, the columns of V orthonormal.
template <class S, int N>
struct symmetric_eigen {
  Eigen::Matrix<S, N, 1> values;
  Eigen::Matrix<S, N, N> vectors;

  /// Of a symmetric g with finite entries. Does not allocate.
  explicit symmetric_eigen(Eigen::Matrix<S, N, N> g) {
    for (int k = 0; k < N * N; ++k) vectors.data()[k] = S(k % (N + 1) == 0 ? 1 : 0);
    for (int sweep = 0; sweep < 60 && rotate_all(g); ++sweep) {
    }
    for (int k = 0; k < N; ++k) values[k] = g.coeff(k, k);
  }

 private:
  /// One rotation for each pair whose entry is felt; false if there was none.
  bool rotate_all(Eigen::Matrix<S, N, N>& g) {
    using std::abs;
    using std::sqrt;
    bool rotated = false;
    for (int p = 0; p < N; ++p) {
      for (int q = p + 1; q < N; ++q) {
        S const off = g.coeffRef(p, q);
        S const size = sqrt(S(abs(g.coeffRef(p, p)))) * sqrt(S(abs(g.coeffRef(q, q))));
        if (!(S(abs(off)) > std::numeric_limits<S>::epsilon() * size)) continue;
        rotated = true;
        S const θ = (g.coeffRef(q, q) - g.coeffRef(p, p)) / (S(2) * off);
        S const tangent = (θ < S(0) ? S(-1) : S(1)) / (S(abs(θ)) + S(sqrt(S(θ * θ + S(1)))));
        S const c = S(1) / S(sqrt(S(tangent * tangent + S(1))));
        S const s = tangent * c;
        auto const rotate = [&](S& a, S& b) {
          S const old = a;
          a = c * old - s * b;
          b = s * old + c * b;
        };
        for (int k = 0; k < N; ++k) rotate(g.coeffRef(k, p), g.coeffRef(k, q));
        for (int k = 0; k < N; ++k) rotate(g.coeffRef(p, k), g.coeffRef(q, k));
        for (int k = 0; k < N; ++k) rotate(vectors.coeffRef(k, p), vectors.coeffRef(k, q));
        g.coeffRef(p, q) = g.coeffRef(q, p) = S(0);
      }
    }
    return rotated;
  }
};

}  // namespace slant::detail
