// SPDX-License-Identifier: MIT
//
// Coulomb friction in one call:
//
//     auto s = slant::contact::solve_friction(problem);
//     if (s.converged()) use(s.r, s.u);
//
// Block Gauss–Seidel with exact contacts comes first, and is all that most problems need. Where it
// crawls, as it does where forces are redundant or the contacts far apart, semismooth Newton on the
// natural map starts from where it is; where that finds no descent, an interior-point method comes
// once from inside of the cones. If it does not solve the problem either, the proximal point method
// follows the path of forces to where Newton's finds descent, and then the sweeps go on from where
// they were, ever longer. So each problem is solved by the method that suits it, without
// settings, and a problem without solution ends when turns no longer lessen the error, or at the
// limits of the options.
#pragma once

#include <slant/compiled.hpp>
#include <slant/contact/asymmetry.hpp>
#include <slant/contact/detail/friction_run.hpp>
#include <slant/contact/friction_options.hpp>

namespace slant::contact {

/// Solves the problem of friction_problem.hpp. `start`: forces from before, in the units of the
/// problem; empty for none. Throws bad_input if the problem, the options or the start are not
/// valid, or W is not symmetric and the option says refused; whatever goes wrong later is the
/// status: iteration_limit, stalled (no method gets further) or breakdown, also where forces or
/// velocities are out of the range of numbers in the units of the problem.
template <scalar S>
[[nodiscard]] friction_result<S> solve_friction(
    friction_problem<S> const& problem, friction_options<S> const& options = {},
    typename friction_problem<S>::vector_type const& start = {}) {
  problem.validate();
  options.validate();
  if (start.size() != 0) {
    slant::detail::check_size("start", index(start.size()), index(problem.q.size()));
    slant::detail::check_finite("start", start);
  }
  if (options.asymmetry == asymmetric_data::refused) require_symmetric("W", problem.W);
  return problem.dimension() == 2 ? detail::friction_run<2, S>(problem, options).result(start)
                                  : detail::friction_run<3, S>(problem, options).result(start);
}

#if SLANT_USES_COMPILED
extern template friction_result<double> solve_friction<double>(friction_problem<double> const&,
                                                               friction_options<double> const&,
                                                               Eigen::VectorXd const&);
#endif

}  // namespace slant::contact
