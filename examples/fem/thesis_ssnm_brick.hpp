// SPDX-License-Identifier: MIT
//
// SSNM on the dual problem of the steel brick, for Table 4.9 of the thesis. The tractions are not
// printed, so ours are others, and with them the counts.
#pragma once

#include <fem/steel_brick.hpp>
#include <fem/thesis_ssnm.hpp>
#include <slant/factorizations/factorize.hpp>

namespace fem {

/// The dual problem of the steel brick with its dense matrix A = B K⁻¹Bᵀ, as [T] forms it.
struct dense_dual_brick {
  Eigen::MatrixXd A;
  Eigen::VectorXd b;
  Eigen::VectorXd g;  ///< radii

  explicit dense_dual_brick(contact_scene<3> const& s) : g(s.g) {
    auto const factor = slant::factorize(s.K);
    auto const m = s.d.size();
    Eigen::MatrixXd Bt(s.f.size(), 3 * m);
    Bt << Eigen::MatrixXd(s.N).transpose(), Eigen::MatrixXd(s.T).transpose();
    Eigen::MatrixXd KinvBt(s.f.size(), 3 * m);
    auto w = slant::workspace(factor, Bt);
    factor.solve(Bt, KinvBt, w);
    A = Bt.transpose() * KinvBt;
    A = (0.5 * (A + A.transpose())).eval();
    b = KinvBt.transpose() * s.f;
    b.head(m) -= s.d;
  }
  /// λ_ν ≥ 0, ‖λ_t,i‖ ≤ gᵢ.
  [[nodiscard]] auto set() const {
    return slant::cartesian(slant::half_lines(g.size()), slant::discs(g));
  }
};

/// SSNM on the dual problem of the brick [T Table 4.9], from zero.
template <class Solver>
[[nodiscard]] ssnm_run run_brick_ssnm(dense_dual_brick const& brick, Solver solver,
                                      slant::ssnm_options<double> const& options) {
  auto const set = brick.set();
  auto const A = slant::matrix<slant::self_adjoint, slant::positive_definite>(brick.A);
  return run_ssnm(slant::separable_qp{A, brick.b, set}, solver, options,
                  Eigen::VectorXd::Zero(brick.b.size()).eval(), 1e-6, 300);
}

}  // namespace fem
