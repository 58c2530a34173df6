// SPDX-License-Identifier: MIT
//
// The constraints that both preconditioners of the dual operator are made of.
#pragma once

#include <slant/concepts/checks.hpp>

#include <Eigen/SparseCore>

namespace slant::contact::detail {

/// D B with D = diag(B Bᵀ)⁻¹, so that D B Bᵀ = I where rows of B are orthogonal. Empty rows stay
/// empty. Throws bad_input if K is not square or B has not as many columns.
template <class S>
[[nodiscard]] Eigen::SparseMatrix<S> scaled_constraints(Eigen::SparseMatrix<S> const& K,
                                                        Eigen::SparseMatrix<S> const& B) {
  slant::detail::check_size("columns of K", K.cols(), K.rows(), "as many as rows,");
  slant::detail::check_size("columns of B", B.cols(), K.rows(), "the size of K,");
  Eigen::Matrix<S, Eigen::Dynamic, 1> D = Eigen::Matrix<S, Eigen::Dynamic, 1>::Zero(B.rows());
  for (index j = 0; j < B.outerSize(); ++j) {
    for (typename Eigen::SparseMatrix<S>::InnerIterator e(B, j); e; ++e) {
      D(e.row()) += e.value() * e.value();
    }
  }
  for (S& d : D) d = d > S(0) ? S(S(1) / d) : S(0);
  return D.asDiagonal() * B;
}

}  // namespace slant::contact::detail
