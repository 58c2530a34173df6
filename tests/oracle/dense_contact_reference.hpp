// SPDX-License-Identifier: MIT
//
// High-accuracy reference for contact with Tresca friction. The dual matrix A = B K⁻¹Bᵀ is formed
// densely from a Cholesky factor of K, the dual problem is solved by a dense nonsmooth
// Newton method, and the result is corrected until the conditions hold for K, N and T themselves
// and not only for the rounded A. Shares no set or method with the library.
#pragma once

#include <Eigen/SparseCholesky>
#include <oracle/certificate.hpp>
#include <oracle/contact_conditions.hpp>
#include <oracle/dense_newton.hpp>

namespace oracle {

struct contact_reference {
  Eigen::VectorXd u;           ///< displacement
  Eigen::VectorXd normal;      ///< λ_ν
  Eigen::VectorXd tangential;  ///< λ_t, rows 2i and 2i+1 belong to node i
  dense_qp dual;               ///< A and b with which λ solves the dual problem to the last bit
  newton_report report;
  certificate proof;              ///< optimality of λ in the dual problem
  double energy_error = 0;        ///< proven bound of ‖u − u*‖_K / ‖u‖_K
  contact_violations violations;  ///< of the conditions on K, N, T

  /// (λ_ν, λ_τ).
  [[nodiscard]] Eigen::VectorXd multipliers() const {
    Eigen::VectorXd λ(normal.size() + tangential.size());
    λ << normal, tangential;
    return λ;
  }
};

/// Relative error in the energy norm, ‖u − u_ref‖_K / ‖u_ref‖_K.
[[nodiscard]] double energy_error(sparse const& K, Eigen::VectorXd const& u,
                                  Eigen::VectorXd const& reference);

using cholesky = Eigen::SimplicialLLT<sparse, Eigen::Lower, Eigen::NaturalOrdering<int>>;

/// Dual problem of the contact problem with dense A; c = (d, 0).
[[nodiscard]] dense_qp dense_dual(contact_data const& p, cholesky const& K);

/// u = K⁻¹(f − Bᵀλ) in the long type by iterative refinement.
[[nodiscard]] real_vector recover(contact_data const& p, cholesky const& K, real_vector const& λ);

/// Solves the contact problem. Throws std::runtime_error when K is not positive definite or the
/// iteration does not converge.
[[nodiscard]] contact_reference solve_contact(contact_data const& p);

}  // namespace oracle
