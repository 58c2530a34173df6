// SPDX-License-Identifier: MIT
//
// Wires for the tests of the saddle-point solvers, in the units of [T], with their solutions.
#pragma once

#include <doctest/doctest.h>
#include <fem/thesis_ssnm.hpp>
#include <oracle/wire_reference.hpp>

namespace test {

/// Largest error of x against a dense solution in long double, relative to the largest component.
inline double wire_error(Eigen::VectorXd const& x, oracle::wire_reference const& reference) {
  Eigen::VectorXd const exact = reference.report.x.cast<double>();
  return (x - exact).cwiseAbs().maxCoeff() / exact.cwiseAbs().maxCoeff();
}

/// The run ended at the solution, with the printed numbers of active constraints.
inline void check_wire(fem::ssnm_run const& r, oracle::wire_reference const& reference,
                       fem::wire<> const& w, double l, double g, fem::active_counts printed) {
  CHECK(r.converged());
  CHECK(wire_error(r.x, reference) <= 1e-6);
  CHECK(fem::count_active(fem::wire_set(w, l, g), w.A, w.b, r.x) == printed);
}

}  // namespace test
