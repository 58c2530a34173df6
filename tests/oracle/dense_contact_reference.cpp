// SPDX-License-Identifier: MIT
#include <oracle/dense_contact_reference.hpp>

namespace oracle {

double energy_error(sparse const& K, Eigen::VectorXd const& u, Eigen::VectorXd const& reference) {
  Eigen::VectorXd const e = u - reference;
  return std::sqrt(e.dot(K * e) / reference.dot(K * reference));
}

dense_qp dense_dual(contact_data const& p, cholesky const& K) {
  Eigen::Index const m = p.m();
  Eigen::Index const n = m + p.T.rows();
  Eigen::MatrixXd Y(p.K.rows(), n);
  Y << Eigen::MatrixXd(p.N).transpose(), Eigen::MatrixXd(p.T).transpose();
  Eigen::VectorXd w = p.f;
  K.matrixL().solveInPlace(Y);
  K.matrixL().solveInPlace(w);
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

real_vector recover(contact_data const& p, cholesky const& K, real_vector const& λ) {
  real_vector const right = p.f.cast<real>() - multiply(p.N, λ.head(p.m()), true) -
                            multiply(p.T, λ.tail(p.T.rows()), true);
  real_vector u = real_vector::Zero(p.K.rows());
  real_vector rest = right;
  for (int pass = 0; pass < 8 && !rest.isZero(0); ++pass) {
    real const size = rest.cwiseAbs().maxCoeff();
    Eigen::VectorXd const du = K.solve((rest / size).cast<double>());
    u += size * du.cast<real>();
    rest = right - multiply(p.K, u);
  }
  return u;
}

contact_reference solve_contact(contact_data const& p) {
  cholesky const K(p.K);
  if (K.info() != Eigen::Success) throw std::runtime_error("solve_contact: K is not definite");
  contact_reference result;
  result.dual = dense_dual(p, K);
  result.report = solve_dense(result.dual);
  real_vector λ = result.report.x;
  real_vector u = recover(p, K, λ);
  for (int pass = 0; pass < 3; ++pass) {
    // The gradient as K sees it; b absorbs what the rounded A misses of it.
    real_vector r(λ.size());
    r << p.d.cast<real>() - multiply(p.N, u), -multiply(p.T, u);
    result.dual.b += result.dual.gradient(λ) - r;
    newton_report const polished = solve_dense(result.dual, λ);
    result.report.newton_steps += polished.newton_steps;
    result.report.residual = polished.residual;
    λ = polished.x;
    u = recover(p, K, λ);
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
