// SPDX-License-Identifier: MIT
//
// The lumped preconditioner of the dual operator A = B K⁻¹ Bᵀ [Farhat, Roux 1991],
//
//     M = D B K Bᵀ D,     D = diag(B Bᵀ)⁻¹,
//
// an approximation of A⁻¹ that costs a product by a sparse matrix of the size of the contact: where
// A maps forces of the contact nodes to displacements by way of all bodies, M maps displacements
// back to forces as if their neighbours did not move.
#pragma once

#include <slant/concepts/checks.hpp>
#include <slant/concepts/laws.hpp>
#include <slant/operators/matrix.hpp>

#include <Eigen/SparseCore>

#include <utility>

namespace slant::contact {

/// M for a stiffness matrix K (n_u × n_u, both triangles) and constraints B (n × n_u), for example
/// dual::constraints(). An empty row of B, which nothing acts on, gives an empty row of M. The
/// result owns its matrix. Throws bad_input if sizes do not match.
template <class S>
[[nodiscard]] auto lumped_preconditioner(Eigen::SparseMatrix<S> const& K,
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
  Eigen::SparseMatrix<S> const scaled = D.asDiagonal() * B;
  Eigen::SparseMatrix<S> const forces = K * Eigen::SparseMatrix<S>(scaled.transpose());
  Eigen::SparseMatrix<S> M = scaled * forces;
  return slant::matrix<self_adjoint, positive_semidefinite>(std::move(M));
}

}  // namespace slant::contact
