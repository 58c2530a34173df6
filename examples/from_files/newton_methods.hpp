// SPDX-License-Identifier: MIT
//
// The runs of Newton's methods that take more than a line.
#pragma once

#include <algorithm>
#include <slant/contact/preconditioners.hpp>
#include <slant/contact/primal_dual.hpp>
#include <slant/krylov/spectrum.hpp>
#include <slant/methods/interior_point.hpp>
#include <slant/methods/ssnm.hpp>
#include <slant/newton/krylov_solvers.hpp>
#include <slant/newton/semismooth_newton.hpp>
#include <slant/slanting/projection.hpp>
#include <utility>

#include "any_dual.hpp"
#include "dense_dual.hpp"
#include "outcome.hpp"
#include "problem_folder.hpp"

namespace from_files {

/// Path following, with the preconditioner that K offers for nothing.
[[nodiscard]] inline outcome run_interior_point(problem const& p, any_dual const& dual,
                                                Eigen::VectorXd const& λ0, settings const& s) {
  return run_on_dual(
      slant::interior_point{dual.qp(),
                            slant::contact::lumped_preconditioner(p.K, dual.constraints()),
                            {.inner_share = 0.3}},
      λ0, s);
}

/// Newton's method for λ − P(λ − ρ(A λ − b)) with a linear solver and a globalisation.
template <class Solver, class Search, class Forcing>
[[nodiscard]] outcome run_natural_residual(any_dual const& dual, Eigen::VectorXd const& λ0,
                                           settings const& s, Solver solver, Search search,
                                           Forcing forcing) {
  auto const& A = dual.a();
  auto const step = slant::mean_step(A, λ0, 0.5);
  auto const F = slant::natural_residual(A, dual.b(), dual.set(), step.length);
  outcome result = run_and_project(
      slant::semismooth_newton{F, std::move(solver), std::move(search), std::move(forcing)}, λ0, s,
      dual);
  result.work.setup_applications += step.applications;
  return result;
}

/// [K (46)–(54)], displacements and multipliers in one nonsymmetric system.
template <class Friction>
[[nodiscard]] outcome run_primal_dual(Friction friction, problem const& p, any_dual const& dual,
                                      Eigen::VectorXd const& λ0, settings const& s) {
  auto const K = slant::matrix<slant::self_adjoint, slant::positive_definite>(p.K);
  slant::contact::primal_dual const contact(friction, K, p.contact);
  auto const G = contact.function(p.K.diagonal().mean());
  Eigen::VectorXd y0(G.cols());
  y0 << dual.displacement(λ0), λ0;
  auto const forces = [&](Eigen::VectorXd const& y) {
    return slant::project(dual.set(), contact.multipliers(y));
  };
  // The forces alone are judged: displacements follow from them by a solve with K.
  certificate const error_of = [&](Eigen::VectorXd const& y) { return s.error_of(forces(y)); };
  return run_until(
      slant::semismooth_newton{G, slant::bicgstab_solver{}, slant::halving_line_search{},
                               slant::adaptive_precision{}},
      y0, slant::energy_error_below(s.tolerance, error_of), s, forces);
}

/// The same for the law that T stands for.
[[nodiscard]] inline outcome run_primal_dual(problem const& p, any_dual const& dual,
                                             Eigen::VectorXd const& λ0, settings const& s) {
  switch (p.contact.tangents()) {
    case 0:
      return run_primal_dual(slant::contact::frictionless{}, p, dual, λ0, s);
    case 1:
      return run_primal_dual(slant::contact::friction_line{}, p, dual, λ0, s);
    default:
      return run_primal_dual(slant::contact::friction_disc{}, p, dual, λ0, s);
  }
}

/// SSNM of the thesis; A is formed and factored. It has nothing against cycles: as there, 1000
/// steps are the most.
template <class Solver>
[[nodiscard]] outcome run_ssnm(any_dual const& dual, Eigen::VectorXd const& λ0, settings const& s,
                               Solver solver) {
  dense_dual const dense(dual);
  slant::ssnm_options<double> options;
  options.rho = dense.mean() > 0 ? dense.mean() : 1;
  options.precision = {.r_tol = 0.1, .c_fact = 0.5};
  options.multipliers = slant::ssnm_multipliers::estimated;
  settings limited = s;
  limited.max_iterations = std::min<slant::index>(s.max_iterations, 1000);
  outcome result = run_and_project(slant::ssnm{dense.qp(), solver, options}, λ0, limited, dual);
  result.work.setup_applications += dense.products();
  return result;
}

}  // namespace from_files
