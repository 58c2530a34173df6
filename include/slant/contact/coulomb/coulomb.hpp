// SPDX-License-Identifier: MIT
//
// Contact with Coulomb friction, ‖λ_t,i‖ ≤ Fᵢ λ_ν,i, by successive approximations over Newton's
// method:
//
//     contact::dual problem(contact::friction_disc{}, factor, data);
//     contact::coulomb_radii family(problem, contact::coefficients(F));
//     auto const M = contact::lumped_preconditioner(K, problem.constraints());
//     auto const r = slant::solve(contact::coulomb(family, M, {.goal = 1e-8}), problem.zero(),
//                                 slant::reduced_gradient_below(1e-8) || slant::at_most(100));
//     auto const u = problem.displacement(r.x());
//
// With the goal the last problem is not solved better than that. Relative to ‖b‖ any forces of a
// body that nearly moves rigidly are a solution (a brick 300 × 1 × 1: pressure and friction off by
// 1e-3, a thin one: by all): contact::certified_coulomb goes on where a certificate says so.
//
// Families: coulomb_radii (the slip bounds of Tresca's problem are F λ_ν; any coefficients of
// friction_law.hpp), coulomb_cones (cones, with shifts μ‖u_t‖; multipliers contact by
// contact). With contact::load_stepper it goes through a sequence of load steps:
//
//     contact::load_stepper stepper(family, contact::coulomb(family, M, {.goal = 1e-8}), stop);
//     auto const& step = stepper.advance({.f = f, .w = w});      // w: T u of the step before
#pragma once

#include <slant/contact/coulomb/coulomb_families.hpp>
#include <slant/methods/successive_approximations.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/operators/identity.hpp>

#include <type_traits>
#include <utility>

namespace slant::contact {

/// Options of `coulomb`.
template <class S = double>
struct coulomb_options {
  double goal = 0;  ///< the relative reduced gradient one stops at: nothing is solved much better
  successive_options<S> outer{};  ///< its forcing.goal is set to `goal`
  /// Its forcing.goal is set in each outer step. Newton steps are few in each of them: solved by a
  /// factor 10 they save about a tenth of the products, measured on bricks (k = 6).
  symmetric_newton_options<S> newton{
      .forcing = {.γ = 0.9, .exponent = 1.5, .η_max = 0.1, .η_first = 0.1}};
};

namespace detail {

/// Makes the inner methods of `coulomb`; refers to family and preconditioner.
template <class Family, class M>
struct coulomb_newton {
  Family const* family;
  M const* m;
  symmetric_newton_options<typename Family::scalar> options;

  [[nodiscard]] auto operator()(typename Family::scalar goal) const {
    auto o = options;
    o.forcing.goal = static_cast<double>(goal);
    return symmetric_newton{family->qp(), *m, o};
  }
};

}  // namespace detail

/// The method at the top of this file, with a preconditioner M ≈ A⁻¹ of family.qp(). Refers to
/// both. Throws bad_input for options out of range.
template <class Family, class M>
[[nodiscard]] auto coulomb(Family& family, M const& m,
                           coulomb_options<typename Family::scalar> o = {}) {
  o.outer.forcing.goal = o.goal;
  return successive_approximations(
      family, detail::coulomb_newton<Family, M>{&family, &m, std::move(o.newton)},
      std::move(o.outer));
}
template <class Family, class M>
auto coulomb(Family&, M const&&, coulomb_options<typename Family::scalar> = {}) = delete;

}  // namespace slant::contact
