// SPDX-License-Identifier: MIT
//
// Bases of the kernel of a symmetric positive semidefinite matrix K, and the rows at which to hold
// a body so that it cannot move along them.
//
// Fixing rows. Let R (n × d, orthonormal columns) span ker K and J be d rows with regular R_J. Then
// K without the rows and columns J is regular, and everything that is computed with it is amplified
// by R R_J⁻¹ at most: that is the motion of the whole body when the unknowns J move by one. So J is
// chosen as a submatrix of locally maximal volume [Goreinov, Oseledets, Savostyanov, Tyrtyshnikov,
// Zamarashkin 2010]: QR with column pivoting of Rᵀ, then rows are exchanged as long as |det R_J|
// grows. At the end no entry of R R_J⁻¹ exceeds 1 by more than a twentieth, whatever the shape of
// the body: its rows are as far apart as the body is long. Three nodes anywhere, the middle and two
// neighbours say, would give R R_J⁻¹ the size of the ratio of length and distance.
#pragma once

#include <slant/base/matrix_entries.hpp>
#include <slant/compiled.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/random.hpp>
#include <slant/factorizations/factorize.hpp>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SparseCore>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace slant {

namespace detail {

/// Orthonormal columns that span those of R, as many as R has independent ones: up to 1024 ε, each
/// column measured by its own length. Entries are finite.
template <class S>
[[nodiscard]] Eigen::MatrixX<S> orthonormal_basis(Eigen::MatrixX<S> R) {
  using matrix_type = Eigen::MatrixX<S>;
  for (index j = 0; j < R.cols(); ++j) {
    S const largest = R.rows() > 0 ? S(R.col(j).cwiseAbs().maxCoeff()) : S(0);
    if (!(largest > S(0))) continue;
    R.col(j) /= largest;
    R.col(j) /= R.col(j).norm();
  }
  if (R.rows() == 0 || R.cols() == 0) return matrix_type(R.rows(), 0);
  Eigen::ColPivHouseholderQR<matrix_type> qr;
  qr.setThreshold(S(1024) * std::numeric_limits<S>::epsilon());
  qr.compute(R);
  // The first columns of Q = H₀ H₁ …, H_k = I − τ v vᵀ, v the part of column k from its diagonal
  // entry on, which is 1: what householderQ() does, and is slow to compile.
  matrix_type const& v = qr.matrixQR();
  matrix_type Q = matrix_type::Identity(R.rows(), qr.rank());
  for (index k = qr.rank(); k-- > 0;) {
    for (index j = k; j < Q.cols(); ++j) {
      S sum = Q(k, j);
      for (index i = k + 1; i < Q.rows(); ++i) sum += v(i, k) * Q(i, j);
      sum *= qr.hCoeffs()[k];
      Q(k, j) -= sum;
      for (index i = k + 1; i < Q.rows(); ++i) Q(i, j) -= sum * v(i, k);
    }
  }
  return Q;
}

/// ‖K R‖ / (‖K‖ ‖R‖) that rounding errors of the assembly of K and of R may make.
template <class S>
[[nodiscard]] S kernel_rounding() {
  return S(1024) * std::numeric_limits<S>::epsilon();
}

/// Throws bad_input with the measured and the expected ‖K R‖ unless K R = 0 up to rounding, in the
/// maximum norm. Sizes match, entries are finite.
template <class S, class R>
void require_kernel(Eigen::SparseMatrix<S> const& K, R const& kernel) {
  if (kernel.size() == 0) return;
  S const size = largest_row_sum(K) * kernel.cwiseAbs().maxCoeff();
  S const residual = (K * kernel).cwiseAbs().maxCoeff();
  S const most = kernel_rounding<S>() * size;
  if (residual <= most) return;
  throw bad_input("R", "max |K R| = " + brief(residual),
                  "columns in the kernel of K: max |K R| at most " + show(most) + " = " +
                      show(kernel_rounding<S>()) + " max |R| times the largest row sum of |K|");
}

}  // namespace detail

/// Rows J of R, as many as it has columns, for which R_J is regular and |R R_J⁻¹| ≤ 1.05: see the
/// top of this file. In increasing order. The columns of R are independent, else bad_input.
template <class M>
[[nodiscard]] std::vector<index> fixing_rows(Eigen::MatrixBase<M> const& R) {
  using S = typename M::Scalar;
  using matrix_type = Eigen::MatrixX<S>;
  detail::require_finite_entries("R", R.derived());
  index const d = R.cols();
  std::vector<index> rows;
  if (d == 0) return rows;
  Eigen::ColPivHouseholderQR<matrix_type> qr;
  qr.setThreshold(S(1024) * std::numeric_limits<S>::epsilon());
  matrix_type const transposed = R.transpose();
  qr.compute(transposed);
  if (qr.rank() < d) {
    throw bad_input("columns of R", "rank " + detail::show(index(qr.rank())),
                    detail::show(d) + " independent ones");
  }
  auto const& order = qr.colsPermutation().indices();
  for (index j = 0; j < d; ++j) rows.push_back(order[j]);
  // Each exchange multiplies the volume by more than 1.05, so there are few.
  while (true) {
    matrix_type const held = transposed(Eigen::all, rows);
    qr.compute(held);
    matrix_type const amplification = qr.solve(transposed);
    index j = 0, i = 0;
    if (!(amplification.cwiseAbs().maxCoeff(&j, &i) > S(1.05))) break;
    rows[static_cast<std::size_t>(j)] = i;
  }
  std::sort(rows.begin(), rows.end());
  return rows;
}

#if SLANT_USES_COMPILED
extern template Eigen::MatrixXd detail::orthonormal_basis<double>(Eigen::MatrixXd);
extern template std::vector<index> fixing_rows<Eigen::MatrixXd>(
    Eigen::MatrixBase<Eigen::MatrixXd> const&);
#endif

// --- computed kernel -----------------------------------------------------------------------------
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

namespace detail {

/// How many of the vectors X, of length 1, have ‖K x‖ ≤ limit.
template <class S>
[[nodiscard]] index count_below(Eigen::SparseMatrix<S> const& K, Eigen::MatrixX<S> const& X,
                                S const& limit) {
  Eigen::MatrixX<S> const image = K * X;
  index count = 0;
  for (index j = 0; j < image.cols(); ++j) count += image.col(j).norm() <= limit ? 1 : 0;
  return count;
}

}  // namespace detail

/// An orthonormal basis of ker K, n × d, d ≥ 0. Costs one factorisation and a few solves with eight
/// right-hand sides (twice as many as the kernel has dimensions, if those are more than eight).
/// Throws bad_input if K is not symmetric or not semidefinite, or if it has eigenvalues of which
/// the precision does not tell whether they are zero.
template <class S>
[[nodiscard]] Eigen::MatrixX<S> computed_kernel(Eigen::SparseMatrix<S> const& K) {
  using matrix_type = Eigen::MatrixX<S>;
  using vector_type = Eigen::VectorX<S>;
  using std::sqrt;
  detail::require_symmetric_matrix("K", K);
  index const n = K.rows();
  if (n == 0) return matrix_type(0, 0);
  vector_type scale = K.diagonal();
  // An unknown without stiffness is a direction of the kernel, in the units of the others; a negative
  // one is refused below.
  S const stiffest = scale.maxCoeff() > S(0) ? scale.maxCoeff() : S(1);
  for (S& d : scale) d = S(1) / sqrt(d > S(0) ? d : stiffest);
  Eigen::SparseMatrix<S> const scaled = scale.asDiagonal() * K * scale.asDiagonal();
  Eigen::SparseMatrix<S> shifted = scaled, unit(n, n);
  unit.setIdentity();
  shifted += S(16) * detail::smallest_pivot(n, S(1)) * unit;
  auto const factors = slant::factorize(shifted);

  S const limit = detail::kernel_rounding<S>() * detail::largest_row_sum(scaled) / S(4);
  detail::random_bits generator(2013);
  for (index width = std::min<index>(n, 8);; width = std::min<index>(n, 2 * width)) {
    matrix_type X(n, width);
    // In [−1, 1), from the bits themselves, since standard libraries differ in their distributions.
    for (index i = 0; i < X.size(); ++i) {
      X(i) = S(static_cast<double>(generator() >> 11U) * 0x1p-52 - 1.0);
    }
    index found = -1;
    for (int step = 0; step < 20; ++step) {
      matrix_type Y(n, X.cols());  // fewer than before, if some were dependent
      auto w = slant::workspace(factors, X);
      detail::solve_with(factors, X, Y, w);
      matrix_type const Q = detail::orthonormal_basis<S>(std::move(Y));
      matrix_type const image = scaled * Q, projected = Q.transpose() * image;
      X = Q * Eigen::SelfAdjointEigenSolver<matrix_type>(projected).eigenvectors();
      index const now = detail::count_below(scaled, X, limit);
      if (now == found && step > 2) break;
      found = now;
    }
    if (found == width && width < n) continue;
    if (detail::count_below(scaled, X, S(S(16) * limit)) > found) {
      throw bad_input("K", "an eigenvalue next to the rounding errors of K",
                      "a kernel that can be told from the rest at this precision; give it as R");
    }
    matrix_type basis = detail::orthonormal_basis<S>(scale.asDiagonal() * X.leftCols(found));
    if (basis.cols() == found) return basis;
    throw bad_input("K", "parts whose stiffnesses differ by more than the precision",
                    "a kernel that can be told from the rest at this precision; give it as R");
  }
}

#if SLANT_USES_COMPILED
extern template Eigen::MatrixXd computed_kernel<double>(Eigen::SparseMatrix<double> const&);
#endif

}  // namespace slant
