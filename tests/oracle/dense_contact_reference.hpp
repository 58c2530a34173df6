// SPDX-License-Identifier: MIT
//
// High-accuracy reference for contact with Tresca friction. The dual matrix A = B K⁻¹Bᵀ is formed
// densely by a Cholesky factorisation of its own, the dual problem is solved by a dense nonsmooth
// Newton method, and the result is corrected until the conditions hold for K, N and T themselves
// and not only for the rounded A. Shares no factorisation, set or method with the library.
#pragma once

#include <oracle/certificate.hpp>
#include <oracle/contact_conditions.hpp>
#include <oracle/dense_newton.hpp>
#include <oracle/envelope_cholesky.hpp>

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
[[nodiscard]] inline double energy_error(sparse const& K, Eigen::VectorXd const& u,
                                         Eigen::VectorXd const& reference) {
  Eigen::VectorXd const e = u - reference;
  return std::sqrt(e.dot(K * e) / reference.dot(K * reference));
}

/// Dual problem of the contact problem with dense A; c = (d, 0).
[[nodiscard]] inline dense_qp dense_dual(contact_data const& p, envelope_cholesky const& L) {
  Eigen::Index const m = p.m();
  Eigen::Index const n = m + p.T.rows();
  envelope_cholesky::row_major Y(p.K.rows(), n);
  Y << Eigen::MatrixXd(p.N).transpose(), Eigen::MatrixXd(p.T).transpose();
  Eigen::VectorXd w = p.f;
  L.forward(Y);
  L.forward(w);
  dense_qp dual;
  dual.A = Y.transpose() * Y;
  dual.b = (Y.transpose() * w).cast<real>();
  dual.b.head(m) -= p.d.cast<real>();
  for (Eigen::Index i = 0; i < m; ++i) dual.intervals.push_back({i, 0.0});
  for (Eigen::Index i = 0; i < m; ++i) {
    if (p.tangents() == 1) dual.intervals.push_back({m + i, -p.g[i], p.g[i]});
    if (p.tangents() == 2) dual.circles.push_back({m + 2 * i, m + 2 * i + 1, p.g[i]});
  }
  return dual;
}

/// u = K⁻¹(f − Bᵀλ) in the long type by iterative refinement.
[[nodiscard]] inline real_vector recover(contact_data const& p, envelope_cholesky const& L,
                                         real_vector const& λ) {
  real_vector const right = p.f.cast<real>() - multiply(p.N, λ.head(p.m()), true) -
                            multiply(p.T, λ.tail(p.T.rows()), true);
  real_vector u = real_vector::Zero(p.K.rows());
  real_vector rest = right;
  for (int pass = 0; pass < 8 && !rest.isZero(0); ++pass) {
    real const size = rest.cwiseAbs().maxCoeff();
    u += size * L.solve((rest / size).cast<double>()).cast<real>();
    rest = right - multiply(p.K, u);
  }
  return u;
}

/// Solves the contact problem. Throws std::runtime_error when K is not positive definite or the
/// iteration does not converge.
[[nodiscard]] inline contact_reference solve_contact(contact_data const& p) {
  envelope_cholesky const L(p.K);
  contact_reference result;
  result.dual = dense_dual(p, L);
  result.report = solve_dense(result.dual);
  real_vector λ = result.report.x;
  real_vector u = recover(p, L, λ);
  for (int pass = 0; pass < 3; ++pass) {
    // The gradient as K sees it; b absorbs what the rounded A misses of it.
    real_vector r(λ.size());
    r << p.d.cast<real>() - multiply(p.N, u), -multiply(p.T, u);
    result.dual.b += result.dual.gradient(λ) - r;
    newton_report const polished = solve_dense(result.dual, λ);
    result.report.newton_steps += polished.newton_steps;
    result.report.residual = polished.residual;
    λ = polished.x;
    u = recover(p, L, λ);
  }
  result.report.x = λ;
  result.proof = certify(result.dual, λ);
  // The dual and the primal error are the same number: ‖λ − λ*‖_A = ‖u − u*‖_K.
  real const dual_energy = λ.dot(result.dual.gradient(λ) + result.dual.b);
  real const energy = u.dot(multiply(p.K, u));
  if (energy > 0)
    result.energy_error =
        result.proof.energy_error * static_cast<double>(std::sqrt(dual_energy / energy));
  result.violations = check_contact(p, u, λ);
  result.u = u.cast<double>();
  result.normal = λ.head(p.m()).cast<double>();
  result.tangential = λ.tail(p.T.rows()).cast<double>();
  return result;
}

}  // namespace oracle
