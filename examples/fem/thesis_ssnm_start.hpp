// SPDX-License-Identifier: MIT
//
// SSNM on the wire from a point that a first-order method has found [T Tables 4.3, 4.4]. [T] has
// "QPC" of its reference [12] for that; here it is KPRGP. As in [T] its accuracy 10⁻ʸ is the lowest
// from which SSNM converges.
#pragma once

#include <cmath>
#include <fem/thesis_ssnm.hpp>
#include <slant/methods/kprgp.hpp>
#include <slant/newton/saddle_solvers.hpp>

namespace fem {

/// What [T Table 4.3] prints as  iterations(first_phase)[accuracy].
struct started_ssnm_run {
  ssnm_run run;
  slant::index first_phase = 0;  ///< steps of the first-order method
  int accuracy = 0;              ///< y of its relative reduced gradient 10⁻ʸ
};

/// SSNM from KPRGP with estimated multipliers, for y = 1, 2, … up to `most`.
[[nodiscard]] inline started_ssnm_run run_started_wire_ssnm(wire<> const& w, double l, double g,
                                                            int most = 6) {
  auto const set = wire_set(w, l, g);
  auto const A = slant::matrix<slant::self_adjoint, slant::positive_definite>(w.A);
  slant::separable_qp const qp{A, w.b, set};
  // The eigenvalues of tridiag(−1, 2, −1) lie below 4.
  slant::kprgp const first{qp, {.step_length = 1.9 / 4}};
  slant::ssnm_options<double> const options{.multipliers = slant::ssnm_multipliers::estimated};
  started_ssnm_run result;
  do {
    ++result.accuracy;
    auto const start = slant::solve(
        first, Eigen::VectorXd::Zero(4 * w.m).eval(),
        slant::reduced_gradient_below(std::pow(10.0, -result.accuracy)) || slant::at_most(100000));
    result.first_phase = start.iterations();
    result.run = run_ssnm(qp, slant::saddle_direct{}, options, start.x());
  } while (!result.run.converged() && result.accuracy < most);
  return result;
}

}  // namespace fem
