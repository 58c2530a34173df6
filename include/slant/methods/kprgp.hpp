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

#include <slant/methods/parts/release_rules.hpp>
#include <slant/methods/proportioning.hpp>
#include <slant/problems/compiled_problem.hpp>
#include <slant/problems/quadratic_program.hpp>

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
  static_assert(detail::program_demands<std::remove_cvref_t<QP>>());
  static_assert(detail::active_set_demands<std::remove_cvref_t<QP>>());

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

// --- qpq -----------------------------------------------------------------------------------------
//
// QPQ [K §3.1.1 Lemma 1, §3.1.4 Table 1], the predecessor of KPRGP: the discontinuous conditions
//
//     φ_i = r_i = 0  where f_i < 0,     β_i = r_i + (‖r_i‖/‖∇f_i‖) ∇f_i = 0  where f_i = 0
//
// decide when a block is released, and −β is the direction:
//
//     ‖β‖ < Γ ‖φ‖:    conjugate gradient step over F; if it leaves Λ, a half step to the boundary
//                     and the expansion  x ← x − α̃ φ̃
//     otherwise:      x ← x − α β,  α = rᵀβ / βᵀA β or what Λ allows of it
//
// The documents tell the conditions and the counts of products, not the algorithm, which is a
// reading: expansion as in KPRGP, and "a feasible minimising step" [K §3.1.1] to release. Of the
// readings that were tried it comes closest to the counts. Half steps alone, without expansion, get
// stuck on Example 1: each adds one block, and β hardly moves it along its curved boundary.
//
// Where a boundary has no normal (the apex of a cone), or a set does not tell its inequalities, the
// reduced gradient stands for β.

/// QPQ for a separable_qp: solve(qpq{qp}, x0, reduced_gradient_below(1e-6) || at_most(500)).
/// Requirements, options and statuses are those of kprgp. One application of A a step, two for an
/// expansion.
template <class QP>
class qpq : public proportioning<QP, kkt_proportioning> {
  static_assert(detail::program_demands<std::remove_cvref_t<QP>>());
  static_assert(detail::active_set_demands<std::remove_cvref_t<QP>>());

 public:
  using qpq::proportioning::proportioning;
};

template <class QP>
qpq(QP&&) -> qpq<kept_t<QP>>;
template <class QP>
qpq(QP&&, kprgp_options<typename std::remove_cvref_t<QP>::scalar>) -> qpq<kept_t<QP>>;

// --- qpc -----------------------------------------------------------------------------------------
//
// QPC, an active set method of Polyak's type: conjugate gradients minimise q on the face, exactly
// or nearly, before blocks are released from the active set. [T Remark 4.2, Table 4.3] starts
// Newton's method from such a first-order phase, whose algorithm is not printed; this is QPQ with
// another rule:
//
//     ‖φ‖ > δ max(‖φ‖ at the first point of the face, ‖β‖):   conjugate gradient step over F; if it
//                     leaves Λ, a half step to the boundary and the expansion  x ← x − α̃ φ̃
//     otherwise:      x ← x − α β,  α = rᵀβ / βᵀA β or what Λ allows of it

/// QPC for a separable_qp: solve(qpc{qp}, x0, reduced_gradient_below(1e-1) || at_most(500)).
/// Requirements and statuses are those of kprgp. One application of A a step, two for an expansion.
template <class QP>
class qpc : public proportioning<QP, face_minimum_release> {
  static_assert(detail::program_demands<std::remove_cvref_t<QP>>());
  static_assert(detail::active_set_demands<std::remove_cvref_t<QP>>());

 public:
  using qpc::proportioning::proportioning;
};

template <class QP>
qpc(QP&&) -> qpc<kept_t<QP>>;
template <class QP>
qpc(QP&&, qpc_options<typename std::remove_cvref_t<QP>::scalar>) -> qpc<kept_t<QP>>;

}  // namespace slant
