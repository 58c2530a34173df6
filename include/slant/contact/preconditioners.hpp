// SPDX-License-Identifier: MIT
//
// Preconditioners of the dual operator A = B K⁻¹Bᵀ: lumped, and Dirichlet.
#pragma once

#include <slant/base/matrix_entries.hpp>
#include <slant/base/partitions.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/laws.hpp>
#include <slant/contact/contact_data.hpp>
#include <slant/factorizations/factorize.hpp>
#include <slant/operators/declare.hpp>
#include <slant/operators/inverse.hpp>
#include <slant/operators/matrix.hpp>
#include <slant/operators/product.hpp>
#include <slant/operators/sum.hpp>

#include <Eigen/SparseCore>

#include <utility>

namespace slant::contact {

namespace detail {

/// D B with D = diag(B Bᵀ)⁻¹, so that D B Bᵀ = I where rows of B are orthogonal. Empty rows stay
/// empty. Throws bad_input if K is not square or B has not as many columns.
template <class S>
[[nodiscard]] Eigen::SparseMatrix<S> scaled_constraints(Eigen::SparseMatrix<S> const& K,
                                                        Eigen::SparseMatrix<S> const& B) {
  slant::detail::check_size("columns of K", K.cols(), K.rows(), "as many as rows,");
  slant::detail::check_size("columns of B", B.cols(), K.rows(), "the size of K,");
  Eigen::VectorX<S> D = row_squares(B);
  for (S& d : D) d = d > S(0) ? S(S(1) / d) : S(0);
  return D.asDiagonal() * B;
}

}  // namespace detail

// --- preconditioner ------------------------------------------------------------------------------
//
// The lumped preconditioner of the dual operator A = B K⁻¹ Bᵀ [Farhat, Roux 1991],
//
//     M = D B K Bᵀ D,     D = diag(B Bᵀ)⁻¹,
//
// an approximation of A⁻¹ that costs a product by a sparse matrix of the size of the contact: where
// A maps forces of the contact nodes to displacements by way of all bodies, M maps displacements
// back to forces as if their neighbours did not move.

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

// --- dirichlet preconditioner --------------------------------------------------------------------
//
// The Dirichlet preconditioner of the dual operator A = B K⁻¹ Bᵀ [Farhat, Mandel, Roux 1994],
//
//     M = D B_c S B_cᵀ D,     S = K_cc − K_ci K_ii⁻¹ K_ic,     D = diag(B Bᵀ)⁻¹,
//
// c the unknowns that B touches, i all others. M maps displacements of the contact nodes to the
// forces that hold them there while the bodies behind them are at rest: the lumped preconditioner
// leaves the bodies out. For one body of which B sees every contact unknown once, M = A⁻¹.
//
// It costs a factorisation of K_ii and a solve with it an application, as much as a product by A:
// worth while where it saves more than half of the products.

/// M for a stiffness matrix K (n_u × n_u, positive definite, both triangles) and constraints B
/// (n × n_u), for example dual::constraints(). The result owns all it needs. Throws bad_input if
/// sizes do not match or K_ii is not positive definite.
template <class S>
[[nodiscard]] auto dirichlet_preconditioner(Eigen::SparseMatrix<S> const& K,
                                            Eigen::SparseMatrix<S> const& B) {
  using matrix_type = Eigen::SparseMatrix<S>;
  matrix_type const scaled = detail::scaled_constraints(K, B);
  auto const contact = touched_unknowns(B);
  // Cᵀx = x_c, Iᵀx = x_i.
  matrix_type const C = slant::detail::columns_of_identity<S>(B.cols(), contact);
  matrix_type const I =
      slant::detail::columns_of_identity<S>(B.cols(), slant::detail::complement(B.cols(), contact));
  matrix_type const rows = C.transpose() * K, interior_rows = I.transpose() * K;
  matrix_type K_cc = rows * C, K_ci = rows * I;
  matrix_type const K_ii = interior_rows * I;
  matrix_type B_c = scaled * C;
  auto complement = declare<self_adjoint, positive_semidefinite>(
      difference(matrix<self_adjoint>(std::move(K_cc)),
                 congruence(matrix(std::move(K_ci)), inverse(factorize(K_ii)))));
  return congruence(matrix(std::move(B_c)), std::move(complement));
}

}  // namespace slant::contact
