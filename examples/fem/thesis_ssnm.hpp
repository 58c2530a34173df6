// SPDX-License-Identifier: MIT
//
// The runs behind the tables of the thesis: SSNM on the wire (Tables 4.1–4.8), with the parameters
// of [T], counted as [T] counts. For the brick see thesis_ssnm_brick.hpp.
//
// [T] does not print its matrix. With A = tridiag(−1, 2, −1) and the load h² f, that is A and b of
// string_1d.hpp times h, the printed iterations of Tables 4.1 and 4.2 come out; with other
// multiples they do not, since ρ = 1 and the absolute inner tolerances mean something else then.
#pragma once

#include <fem/active_counts.hpp>
#include <fem/string_1d.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/iteration/stopping.hpp>
#include <slant/methods/ssnm.hpp>
#include <slant/operators/matrix.hpp>
#include <slant/problems/separable_qp.hpp>
#include <slant/sets/cartesian.hpp>
#include <slant/sets/contact_sets.hpp>
#include <string>

namespace fem {

/// What one run of SSNM did.
struct ssnm_run {
  slant::status status;
  std::string reason;           ///< in words
  slant::index iterations = 0;  ///< Newton steps
  slant::index products = 0;    ///< "Hessian multiplications": K⁻¹ in A and C, F° in B
  double residual = 0;          ///< ‖F(y)‖ at the end
  Eigen::VectorXd x;

  [[nodiscard]] bool converged() const { return status == slant::status::converged; }
};

/// The wire in the units of [T].
[[nodiscard]] inline wire<> make_thesis_wire(Eigen::Index m) {
  wire<> w = make_wire(m);
  double const h = w.h();
  w.A *= h;
  w.b *= h;
  return w;
}

/// Bounds y₂ ≥ l, circles ‖y‖ ≤ g, free unknowns.
[[nodiscard]] inline auto wire_set(wire<> const& w, double l, double g) {
  return slant::cartesian(slant::half_lines(Eigen::VectorXd::Constant(w.m, l).eval()),
                          slant::discs(Eigen::VectorXd::Constant(w.m, g).eval()),
                          slant::free_components(w.m));
}

/// Options with the adaptive precision of [T §3.4], which is absolute.
[[nodiscard]] inline slant::ssnm_options<double> thesis_options(double ρ, double r_tol,
                                                                double c_fact) {
  return {.rho = ρ, .precision = {.r_tol = r_tol, .c_fact = c_fact}, .absolute_precision = true};
}

/// SSNM on any separable_qp until ‖x⁺ − x‖ ≤ tolerance (‖x⁺‖ + 1), the rule of [T], in which 1 has
/// the unit of x.
template <class QP, class Solver>
[[nodiscard]] ssnm_run run_ssnm(QP const& qp, Solver solver,
                                slant::ssnm_options<double> const& options,
                                Eigen::VectorXd const& x0, double tolerance = 1e-6,
                                slant::index most = 1000) {
  auto r = slant::solve(slant::ssnm{qp, solver, options}, x0,
                        slant::step_below(tolerance, 1.0) || slant::at_most(most));
  return {
      r.status, r.reason, r.iterations(), r.state.work.operator_applications, r.state.residual_norm,
      r.state.x};
}

/// SSNM on the wire with n = 4m unknowns, from zero or from x0. Solver: slant::saddle_direct
/// (Tables 4.1–4.4), slant::schur_bicgstab (A), slant::bicgstab_solver (B), slant::schur_cg (C).
template <class Solver>
[[nodiscard]] ssnm_run run_wire_ssnm(wire<> const& w, double l, double g, Solver solver,
                                     slant::ssnm_options<double> const& options,
                                     Eigen::VectorXd const* x0 = nullptr) {
  auto const set = wire_set(w, l, g);
  auto const A = slant::matrix<slant::self_adjoint, slant::positive_definite>(w.A);
  Eigen::VectorXd const zero = Eigen::VectorXd::Zero(4 * w.m);
  return run_ssnm(slant::separable_qp{A, w.b, set}, solver, options, x0 == nullptr ? zero : *x0);
}

}  // namespace fem
