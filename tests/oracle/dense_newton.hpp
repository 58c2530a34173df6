// SPDX-License-Identifier: MIT
//
// Reference solution of a dense_qp by a nonsmooth Newton method in its plainest form: the whole
// generalised Jacobian of x − P(x − ρ(A x − b)), LU with pivoting, iterate in long double so that
// the limit is not rounded to the precision that is to be judged. Started by accelerated projected
// gradients, which converge from anywhere; Newton runs are repeated from ever better starts until
// one converges.
#pragma once

#include <stdexcept>

#include <oracle/dense_qp.hpp>

namespace oracle {

/// Generalised Jacobian (I − G) + G ρ A with G the derivative of the projection at z = x − ρ r,
/// each row of the equation divided by ρ.
[[nodiscard]] Eigen::MatrixXd scaled_jacobian(dense_qp const& qp, real_vector const& z,
                                              Eigen::VectorXd const& ρ);

/// Accelerated projected gradient steps with restart, in double; `count` products with A.
[[nodiscard]] real_vector projected_gradients(dense_qp const& qp, real_vector const& start,
                                              Eigen::VectorXd const& ρ, int count);

struct newton_report {
  real_vector x;
  double residual = 0;  ///< ‖x − P(x − ρ r)‖∞ over the larger of ‖x‖∞ and ‖ρ b‖∞
  int newton_steps = 0;
  int gradient_steps = 0;
};

using dense_lu = Eigen::PartialPivLU<Eigen::MatrixXd>;

/// One Newton run with halved steps: goes on while ‖F‖ decreases. Counts its steps in `steps`.
template <class LU>
[[nodiscard]] real_vector newton_run(dense_qp const& qp, real_vector x, Eigen::VectorXd const& ρ,
                                     int& steps) {
  LU lu;
  bool factors_are_good = false;
  real_vector F = qp.natural_residual(x, ρ);
  for (int step = 0; step < 60 && !F.isZero(0); ++step, ++steps) {
    if (!factors_are_good) {
      real_vector const z = x - ρ.cast<real>().cwiseProduct(qp.gradient(x));
      lu.compute(scaled_jacobian(qp, z, ρ));
    }
    real_vector const right = F.cwiseQuotient(ρ.cast<real>());
    real const size = right.cwiseAbs().maxCoeff();  // keeps the double solve away from underflow
    Eigen::VectorXd const unit_step = lu.solve((right / size).cast<double>());
    real_vector const dx = -size * unit_step.cast<real>();
    real_vector trial = x + dx;
    real_vector F_trial = qp.natural_residual(trial, ρ);
    for (real α = 0.5L; !(F_trial.norm() < F.norm()) && α > 1e-3L; α /= 2) {
      trial = x + α * dx;
      F_trial = qp.natural_residual(trial, ρ);
    }
    if (!(F_trial.norm() < F.norm())) break;
    // After such a step nothing changes sides any more: what is left is iterative refinement.
    factors_are_good = F_trial.norm() < 1e-8L * F.norm();
    x = trial;
    F = F_trial;
  }
  return x;
}

/// Solves to a relative residual of 100 ε of the long type (1e-17) and beyond, as far as it still
/// decreases. Newton runs alternate with more and more gradient steps. Throws std::runtime_error
/// when that does not suffice or the data are not finite: a reference may fail, but it may not be
/// wrong.
template <class LU = dense_lu>
[[nodiscard]] newton_report solve_dense(dense_qp const& qp, real_vector const& start) {
  // fmin, fmax and maxCoeff overlook NaN, so it has to be refused here.
  if (!qp.A.allFinite() || !qp.b.allFinite() || !start.allFinite())
    throw std::runtime_error("solve_dense: data are not finite");
  Eigen::VectorXd const ρ = qp.steps();
  real const data = ρ.cast<real>().cwiseProduct(qp.b).cwiseAbs().maxCoeff();
  newton_report report;
  report.x = qp.project(start);
  for (int gradients = 100; gradients <= 100000; gradients *= 4) {
    real_vector const x = newton_run<LU>(qp, report.x, ρ, report.newton_steps);
    real const scale = std::fmax(x.cwiseAbs().maxCoeff(), data);
    real const residual = qp.natural_residual(x, ρ).cwiseAbs().maxCoeff();
    report.residual = residual == 0 ? 0 : static_cast<double>(residual / scale);
    if (report.residual <= 100 * std::numeric_limits<real>::epsilon()) {
      report.x = qp.project(x);
      return report;
    }
    report.x = projected_gradients(qp, report.x, ρ, gradients);
    report.gradient_steps += gradients;
  }
  throw std::runtime_error("solve_dense: no convergence");
}

/// The same from a start after some gradient steps from zero.
template <class LU = dense_lu>
[[nodiscard]] newton_report solve_dense(dense_qp const& qp) {
  real_vector const zero = real_vector::Zero(qp.size());
  newton_report report = solve_dense<LU>(qp, projected_gradients(qp, zero, qp.steps(), 100));
  report.gradient_steps += 100;
  return report;
}

// Compiled once.
extern template newton_report solve_dense<dense_lu>(dense_qp const&, real_vector const&);
extern template newton_report solve_dense<dense_lu>(dense_qp const&);

}  // namespace oracle
