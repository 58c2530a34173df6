// SPDX-License-Identifier: MIT
//
// KPRGP, "KKT proportioning with reduced gradient projections" [K §3.1.2, (30)–(33), Theorem 1]:
//
//     minimise   q(x) = ½ xᵀA x − bᵀx   over   x ∈ Λ = Λ₁ × … × Λ_m
//
//     r(x)  = A x − b                          gradient
//     r̃(x)  = (x − P_Λ(x − α̃ r)) / α̃           reduced gradient, zero exactly at the solution
//     F, 𝒜  = blocks with f_i < 0, f_i = 0       free and active set; or, with the active sets of
//                                                semismooth Newton, those of P_Λ(x − α̃ r)
//     φ̃, β̃  = r̃ on F, r̃ on 𝒜;   φ = r on F
//
//     (1°) r̃ = 0:                     stop
//     (2°) β̃ᵀr < Γ² φ̃ᵀr:              conjugate gradient step over F; if it leaves Λ, expansion
//                                         x ← x − α̃ φ̃ instead
//     (3°) otherwise:                 proportioning  x ← x − α̃ β̃
//
// Every gradient step is a projected gradient step on some of the blocks: with d its change of x,
// q falls by at least (1/α̃ − σ_max/2) ‖d‖², so α̃ ∈ (0, 2/σ_max) decreases q whatever the sets are.
// For blocks as symmetric as balls, intervals and half lines q falls R-linearly by the factor
// 1 − α̃ σ_min / (2 + 2 max(Γ, 1/Γ)²) a step [K Theorem 1].
//
// Known weakness: on a curved boundary a sliding block moves only by fixed gradient steps.
#pragma once

#include <slant/methods/compiled_problem.hpp>
#include <slant/methods/detail/active_set_complaint.hpp>
#include <slant/methods/proportioning.hpp>
#include <slant/methods/release_rules.hpp>

#include <type_traits>
#include <utility>

namespace slant {

/// KPRGP for a separable_qp: solve(kprgp{qp}, x0, reduced_gradient_below(1e-8) || at_most(500)).
/// Requires: psd_operator (A symmetric positive semidefinite) and separable_set with
/// step_to_boundary. Spends one application of A a step (two for an expansion and for a CG step
/// that recomputes r) and, only if no step_length is given, those for the bound of σ_max at the
/// start. Statuses of its own: converged (r̃ = 0); unbounded (q decreases for ever along
/// −state.directions.p; only if A is not declared definite); stalled (neither ‖r̃‖ nor q fell for
/// `patience` steps, or q falls for ever, but only along a curve on the boundary of a cone);
/// breakdown (a number left the range of the scalar, or A was seen not to be semidefinite).
template <class QP>
class kprgp : public proportioning<QP, reduced_gradient_release> {
  static_assert(detail::active_set_complaint<std::remove_cvref_t<QP>>::made);

 public:
  using kprgp::proportioning::proportioning;
};

template <class QP>
kprgp(QP&&) -> kprgp<compiled_problem_t<QP>>;
template <class QP>
kprgp(QP&&, kprgp_options<typename std::remove_cvref_t<QP>::scalar>)
    -> kprgp<compiled_problem_t<QP>>;

/// AS [K Ex 5], KPRGP by its name for the two-sided bounds of plane friction: solve(as(qp), x0,
/// reduced_gradient_below(1e-6) || at_most(500)).
template <class QP>
[[nodiscard]] auto as(QP&& qp,
                      kprgp_options<typename std::remove_cvref_t<QP>::scalar> options = {}) {
  return kprgp<compiled_problem_t<QP>>(std::forward<QP>(qp), std::move(options));
}

/// AS-S [K Ex 5], KPRGP with the active sets of semismooth Newton: F = blocks with (x − α̃ r)_i
/// inside Λ_i instead of those with x_i inside. [K] states that Theorem 1 holds for it as
/// well, and reports it as the stabler one with steps far beyond 2/σ_max. solve(as_s(qp), x0,
/// reduced_gradient_below(1e-6) || at_most(500)).
template <class QP>
[[nodiscard]] auto as_s(QP&& qp,
                        kprgp_options<typename std::remove_cvref_t<QP>::scalar> options = {}) {
  options.active_sets = active_set_rule::semismooth;
  return slant::as(std::forward<QP>(qp), std::move(options));
}

#if SLANT_USES_COMPILED
extern template struct gradient_point<any_qp<double, definite_laws>>;
extern template struct gradient_point<any_qp<double, semidefinite_laws>>;
extern template class detail::proportioning_steps<any_qp<double, definite_laws>,
                                                  reduced_gradient_release>;
extern template class detail::proportioning_steps<any_qp<double, semidefinite_laws>,
                                                  reduced_gradient_release>;
#endif

}  // namespace slant
