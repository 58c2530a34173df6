// SPDX-License-Identifier: MIT
//
// Contact with Coulomb friction by Newton's method for a natural residual of the whole law, over
// the problem of contact/coulomb/coulomb_families.hpp, multipliers contact by contact:
//
//     coulomb_residual    λ − P(λ − ρ (A λ − b)),   P of slanting/alart_curnier.hpp
//     de_saxce_residual   λ − P_K(λ − ρ (A λ − b + μ‖u_t‖ n))
//
//     contact::coulomb_cones cones(problem, mu);
//     auto const F = contact::coulomb_residual(cones, ρ);
//     auto const r = slant::solve(contact::coulomb_newton(F), cones.zero(),
//                                 slant::residual_below(1e-8) || slant::at_most(100));
//     auto const u = problem.displacement(cones.by_directions(r.x()));
//
// Both refer to the data of the family and see new ones, so load steps go as with any method:
//
//     contact::load_stepper stepper(cones, contact::coulomb_newton(F), residual_below(1e-8) || …);
//
// Where radii and cones are fixed points of linear convergence, this is a Newton method for the
// same equations: superlinear, at the price of nonsymmetric systems and of the safety that each
// convex problem has for itself.
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/contact/coulomb/coulomb_families.hpp>
#include <slant/krylov/mean_diagonal.hpp>
#include <slant/newton/forcing.hpp>
#include <slant/newton/globalisation.hpp>
#include <slant/newton/krylov_solvers.hpp>
#include <slant/newton/semismooth_newton.hpp>
#include <slant/slanting/affine.hpp>
#include <slant/slanting/alart_curnier.hpp>
#include <slant/slanting/arithmetic.hpp>
#include <slant/slanting/de_saxce.hpp>
#include <slant/slanting/projection.hpp>

#include <utility>

namespace slant::contact {

/// ρ = factor / mean(diag A), and what it cost.
template <class Family>
[[nodiscard]] auto residual_step(Family const& family, double factor = 0.5) {
  using S = scalar_t<typename Family::vector_type>;
  return mean_step(family.qp().a(), family.zero(), S(factor), mean_diagonal_options{});
}

/// λ − P(λ − ρ (A λ − b)); ρ in units of 1/A. Refers to the family.
template <class Family, class S>
[[nodiscard]] auto coulomb_residual(Family const& family, S const& ρ) {
  index const n = family.q().size();
  return identity_map(n) -
         slant::alart_curnier_projection<Family::dimension>(family.mu()) *
             (identity_map(n) - slant::positive(ρ) * slant::affine(family.qp().a(), family.q()));
}

/// λ − P_K(λ − ρ û), û = A λ − b + μ‖u_t‖ n; ρ in units of 1/A. Refers to the family.
template <class Family, class S>
[[nodiscard]] auto de_saxce_residual(Family const& family, S const& ρ) {
  index const n = family.q().size();
  return identity_map(n) -
         slant::projection(family.set()) *
             (identity_map(n) -
              slant::positive(ρ) * (slant::de_saxce<Family::dimension>(family.mu()) *
                                    slant::affine(family.qp().a(), family.q())));
}

/// Newton's method for one of them: GMRES, halving line search. `goal` is the relative residual one
/// stops at. F is referenced if it is an lvalue.
template <class F>
[[nodiscard]] auto coulomb_newton(F&& f, double goal = 0, gmres_solver solver = {}) {
  eisenstat_walker const forcing{
      .γ = 0.9, .exponent = 1.5, .η_max = 0.3, .η_first = 0.3, .goal = goal};
  return semismooth_newton{std::forward<F>(f), solver, halving_line_search{.sufficient = 0.1},
                           forcing};
}

}  // namespace slant::contact
