// SPDX-License-Identifier: MIT
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
#pragma once

#include <slant/concepts/laws.hpp>
#include <slant/contact/detail/scaled_constraints.hpp>
#include <slant/factorizations/factorize.hpp>
#include <slant/operators/congruence.hpp>
#include <slant/operators/declare.hpp>
#include <slant/operators/difference.hpp>
#include <slant/operators/inverse.hpp>
#include <slant/operators/matrix.hpp>

#include <Eigen/SparseCore>

#include <utility>
#include <vector>

namespace slant::contact {

namespace detail {

/// Selections of the unknowns that B touches and of the others: C x = x_c, I x = x_i.
template <class S>
struct touched_unknowns {
  Eigen::SparseMatrix<S> C;
  Eigen::SparseMatrix<S> I;

  explicit touched_unknowns(Eigen::SparseMatrix<S> const& B) {
    std::vector<Eigen::Triplet<S>> contact, interior;
    for (index j = 0; j < B.cols(); ++j) {
      bool touched = false;
      for (typename Eigen::SparseMatrix<S>::InnerIterator e(B, j); e && !touched; ++e) {
        touched = e.value() != S(0);
      }
      auto& list = touched ? contact : interior;
      list.emplace_back(static_cast<int>(list.size()), static_cast<int>(j), S(1));
    }
    C = selection(contact, B.cols());
    I = selection(interior, B.cols());
  }

 private:
  static Eigen::SparseMatrix<S> selection(std::vector<Eigen::Triplet<S>> const& entries, index n) {
    Eigen::SparseMatrix<S> m(static_cast<index>(entries.size()), n);
    m.setFromTriplets(entries.begin(), entries.end());
    return m;
  }
};

}  // namespace detail

/// M for a stiffness matrix K (n_u × n_u, positive definite, both triangles) and constraints B
/// (n × n_u), for example dual::constraints(). The result owns all it needs. Throws bad_input if
/// sizes do not match or K_ii is not positive definite.
template <class S>
[[nodiscard]] auto dirichlet_preconditioner(Eigen::SparseMatrix<S> const& K,
                                            Eigen::SparseMatrix<S> const& B) {
  using matrix_type = Eigen::SparseMatrix<S>;
  matrix_type const scaled = detail::scaled_constraints(K, B);
  detail::touched_unknowns<S> const select(B);
  matrix_type const rows = select.C * K, interior_rows = select.I * K;
  matrix_type K_cc = rows * matrix_type(select.C.transpose());
  matrix_type K_ci = rows * matrix_type(select.I.transpose());
  matrix_type const K_ii = interior_rows * matrix_type(select.I.transpose());
  matrix_type B_c = scaled * matrix_type(select.C.transpose());
  auto complement = declare<self_adjoint, positive_semidefinite>(
      difference(matrix<self_adjoint>(std::move(K_cc)),
                 congruence(matrix(std::move(K_ci)), inverse(factorize(K_ii)))));
  return congruence(matrix(std::move(B_c)), std::move(complement));
}

}  // namespace slant::contact
