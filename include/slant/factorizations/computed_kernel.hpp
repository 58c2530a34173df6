// SPDX-License-Identifier: MIT
//
// The kernel of a sparse symmetric positive semidefinite matrix K of which nothing else is known:
// inverse iteration with a shift, on a few vectors at once,
//
//     K̂ = D^{-½} K D^{-½},  D = diag K,     X ← orth((K̂ + s I)⁻¹ X),     Ritz values of K̂ on X,
//
// s just above what a factorisation can tell from zero. The parts of X outside the kernel shrink by
// s/(λ + s) a step, λ the first eigenvalue that is not zero: by far more than ten even for slender
// bodies, so two or three steps do. Errors of the solves have the size of ε ‖K̂‖ ‖X‖ in K̂ X and
// cannot pile up.
//
// Why not the small pivots of a factorisation of K itself: without pivoting the rows in which they
// show are the last ones of a fill-reducing order, which lie side by side. The basis that follows
// from them is amplified as fixing_rows says, and where a pivot counts as small would depend on it.
#pragma once

#include <slant/compiled.hpp>
#include <slant/concepts/random.hpp>
#include <slant/factorizations/factorize.hpp>
#include <slant/factorizations/kernel_basis.hpp>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cstdint>
#include <utility>

namespace slant {

namespace detail {

/// One step of the iteration: X orthonormal, of Ritz vectors in the order of their values.
template <class S, class Factors>
void inverse_iteration(Eigen::SparseMatrix<S> const& K, Factors const& shifted,
                       Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>& X) {
  using matrix_type = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;
  matrix_type Y(X.rows(), X.cols());
  auto w = slant::workspace(shifted, X);
  if constexpr (requires { shifted.solve(X, Y, w); }) {
    shifted.solve(X, Y, w);
  } else {
    shifted.solve(X, Y);
  }
  matrix_type const Q = orthonormal_basis<S>(std::move(Y));
  matrix_type const image = K * Q, projected = Q.transpose() * image;
  Eigen::SelfAdjointEigenSolver<matrix_type> const ritz(projected);
  X = Q * ritz.eigenvectors();
}

/// How many of the vectors X, of length 1, have ‖K x‖ ≤ limit.
template <class S>
[[nodiscard]] index count_below(Eigen::SparseMatrix<S> const& K,
                                Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic> const& X,
                                S const& limit) {
  Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic> const image = K * X;
  index count = 0;
  for (index j = 0; j < image.cols(); ++j) count += image.col(j).norm() <= limit ? 1 : 0;
  return count;
}

/// In [−1, 1): from the bits themselves, since standard libraries differ in their distributions.
template <class S>
[[nodiscard]] S uniform(std::uint64_t bits) {
  return static_cast<S>(static_cast<double>(bits >> 11U) * 0x1p-52 - 1.0);
}

}  // namespace detail

/// An orthonormal basis of ker K, n × d, d ≥ 0. Costs one factorisation and a few solves with eight
/// right-hand sides (twice as many as the kernel has dimensions, if those are more than eight).
/// Throws bad_input if K is not symmetric or not semidefinite, or if it has eigenvalues of which
/// the precision does not tell whether they are zero.
template <class S>
[[nodiscard]] Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic> computed_kernel(
    Eigen::SparseMatrix<S> const& K) {
  using matrix_type = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;
  using vector_type = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  using std::sqrt;
  detail::require_symmetric_matrix("K", K);
  index const n = K.rows();
  if (n == 0) return matrix_type(0, 0);
  vector_type scale = K.diagonal();
  // An unknown without stiffness is a direction of the kernel; a negative one is refused below.
  for (S& d : scale) d = d > S(0) ? S(S(1) / sqrt(d)) : S(1);
  Eigen::SparseMatrix<S> const scaled = scale.asDiagonal() * K * scale.asDiagonal();
  Eigen::SparseMatrix<S> shifted = scaled, unit(n, n);
  unit.setIdentity();
  shifted += S(16) * detail::smallest_pivot(n, S(1)) * unit;
  auto const factors = slant::factorize(shifted);

  S const limit = detail::kernel_rounding<S>() * detail::largest_row_sum(scaled) / S(4);
  detail::random_bits generator(2013);
  for (index width = std::min<index>(n, 8);; width = std::min<index>(n, 2 * width)) {
    matrix_type X(n, width);
    for (index i = 0; i < X.size(); ++i) X(i) = detail::uniform<S>(generator());
    index found = -1;
    for (int step = 0; step < 20; ++step) {
      detail::inverse_iteration(scaled, factors, X);
      index const now = detail::count_below(scaled, X, limit);
      if (now == found && step > 2) break;
      found = now;
    }
    if (found == width && width < n) continue;
    if (detail::count_below(scaled, X, S(S(16) * limit)) > found) {
      throw bad_input("K", "an eigenvalue next to the rounding errors of K",
                      "a kernel that can be told from the rest at this precision; give it as R");
    }
    return detail::orthonormal_basis<S>(scale.asDiagonal() * X.leftCols(found));
  }
}

#if SLANT_USES_COMPILED
extern template Eigen::MatrixXd computed_kernel<double>(Eigen::SparseMatrix<double> const&);
#endif

}  // namespace slant
