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

#include <slant/concepts/laws.hpp>
#include <slant/contact/detail/scaled_constraints.hpp>
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
  Eigen::SparseMatrix<S> const scaled = detail::scaled_constraints(K, B);
  Eigen::SparseMatrix<S> const forces = K * Eigen::SparseMatrix<S>(scaled.transpose());
  Eigen::SparseMatrix<S> M = scaled * forces;
  return slant::matrix<self_adjoint, positive_semidefinite>(std::move(M));
}

}  // namespace slant::contact
