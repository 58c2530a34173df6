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
//                                     x ← x − α̃ φ̃ instead
//     (3°) otherwise:                 proportioning  x ← x − α̃ β̃
//
// Every gradient step is a projected gradient step on some of the blocks: with d its change of x,
// q falls by at least (1/α̃ − σ_max/2) ‖d‖², so α̃ ∈ (0, 2/σ_max) decreases q whatever the sets are.
// For blocks as symmetric as balls, intervals and half lines q falls R-linearly by the factor
// 1 − α̃ σ_min / (2 + 2 max(Γ, 1/Γ)²) a step [K Theorem 1].
//
// Known weakness: on a curved boundary a sliding block moves only by fixed gradient steps.
#pragma once

// First: a complaint about a problem begins with the trail of headers that has led to it.
#include <slant/problems/quadratic_program.hpp>

#include <slant/base/held.hpp>
#include <slant/compiled.hpp>
#include <slant/concepts/convex_set.hpp>
#include <slant/concepts/face.hpp>
#include <slant/methods/parts/gradient_point.hpp>
#include <slant/methods/proportioning.hpp>
#include <slant/sets/face.hpp>

#if SLANT_USES_COMPILED
#include <slant/problems/any_qp.hpp>
#endif

#include <algorithm>
#include <type_traits>
#include <utility>

namespace slant {

// --- kkt vector ----------------------------------------------------------------------------------
//
// The optimality conditions of [K Lemma 1], from which KPRGP's predecessors took their release
// directions: x ∈ Λ solves min q over Λ exactly if r_i = 0 where f_i(x_i) < 0 and
//
//     β_i = r_i + (‖r_i‖ / ‖∇f_i(x_i)‖) ∇f_i(x_i) = 0   where f_i(x_i) = 0.
//
// −β_i halves the angle between the directions that leave Λ_i and those in which q rises. Unlike
// the reduced gradient, β is discontinuous: just inside the boundary r_i stands for it, small or
// not.

namespace detail {

/// A block that tells the inequalities it has.
template <class Block, class X>
concept has_inequalities = has_inequality_form<Block, X> && (Block::inequalities > 0);

/// r + (‖r‖/‖∇f‖) ∇f with the constraint of a block that is the most active at x; `otherwise` where
/// the boundary has no normal.
template <class Block, class X>
[[nodiscard]] X kkt_block(Block const& block, X const& x, X const& r, X const& otherwise) {
  using S = typename X::Scalar;
  auto const values = block.inequality(x);
  auto const gradients = block.inequality_gradient(x);
  index active = 0;
  for (index j = 1; j < values.size(); ++j) {
    if (values(j) > values(active)) active = j;
  }
  X normal = gradients.col(active);
  S const largest = normal.cwiseAbs().maxCoeff();
  if (!(largest > S(0))) return otherwise;
  normal /= largest;  // no overflow of its square, whatever the units of x
  return r + (r.norm() / normal.norm()) * normal;
}

}  // namespace detail

/// Puts β_i in place of β's own entries for the blocks off the face that have a smooth boundary and
/// are not optimal: those with r̃_i = 0 keep what they have, as do blocks and sets that do not tell
/// their inequalities.
template <class Set, class Face, class V>
void kkt_vector(Set const& set, Face const& face, V const& x, V const& r, V const& reduced, V& β) {
  if constexpr (has_visit<Set> && !has_own_face<Set, local_t<V>>) {
    auto& out = slant::local(β);
    set.visit([&](auto const& block, auto const& place) {
      using block_type = std::remove_cvref_t<decltype(block)>;
      if constexpr (has_static_dimension<block_type>) {
        auto const x_i = place.value(slant::local(x));
        using point = std::remove_cvref_t<decltype(x_i)>;
        if constexpr (detail::has_inequalities<block_type, point>) {
          if (face.state(place.index()) == block_state::free) return;
          point const reduced_i = place.value(slant::local(reduced));
          if ((reduced_i.array() == scalar_t<V>(0)).all()) return;
          place.put(out,
                    detail::kkt_block(block, x_i, point(place.value(slant::local(r))), reduced_i));
        }
      }
    });
  }
}

// --- release rules -------------------------------------------------------------------------------
//
// When and how an active set method releases blocks from its active set.
//
//     KPRGP   β̃ = r̃ on 𝒜;   the face is kept while  β̃ᵀr < Γ² φ̃ᵀr;   x ← x − α̃ β̃           [K (33)]
//     QPQ     β of [K Lemma 1];  while  ‖β‖ < Γ ‖φ‖;                  x ← x − α β, α minimises q
//     QPC     β of [K Lemma 1];  until CG has minimised q on the face;  x ← x − α β

/// The rule of KPRGP.
struct reduced_gradient_release {
  static constexpr bool minimising = false;  ///< the step of length α̃ along −β̃, projected

  /// What the two parts of r̃ can gain.
  template <class QP, class State>
  static void weigh(QP const&, State& s) {
    using S = typename State::scalar;
    S const ε = detail::epsilon<S>();
    S const rounding = ε * norm(s.x) / (s.step_length * s.unit);  // of r̃
    S const noise = rounding * norm(s.r);
    s.face.keep(s.reduced, s.φ);
    s.φr = gain(s.φ, s.r, noise);
    s.face.keep_complement(s.reduced, s.φ);
    s.βr = gain(s.φ, s.r, noise);
  }

  /// [K (33)]: the error on the active set is small against the one on the free set.
  template <class State, class Options>
  static bool keeps_face(State const& s, Options const& o) {
    return s.βr < o.proportioning * o.proportioning * s.φr;
  }
};

/// The rule of QPQ: φ and the vector β of [K Lemma 1], along which q is minimised.
struct kkt_release {
  static constexpr bool minimising = true;

  /// ‖φ‖² and ‖β‖².
  template <class QP, class State>
  static void weigh(QP const& qp, State& s) {
    s.face.keep(s.r, s.φ);
    s.φr = inner_product(s.φ, s.φ);
    release_direction(qp, s, s.φ);
    s.βr = inner_product(s.φ, s.φ);
  }

  /// β.
  template <class QP, class State, class V>
  static void release_direction(QP const& qp, State const& s, V& β) {
    s.face.keep_complement(s.reduced, β);
    kkt_vector(qp.set(), s.face, s.x, s.r, s.reduced, β);
  }

  /// ‖β‖ < Γ ‖φ‖.
  template <class State, class Options>
  static bool keeps_face(State const& s, Options const& o) {
    return s.βr < o.proportioning * o.proportioning * s.φr;
  }
};

/// The rule of QPC.
struct face_minimum_release : kkt_release {
  /// Is ‖φ‖ larger than a fraction of what it was on this face at first, and of ‖β‖? True if there
  /// is nothing to release.
  template <class State, class Options>
  static bool keeps_face(State const& s, Options const& o) {
    using S = typename State::scalar;
    S const scale = std::max<S>(s.φr_at_restart, s.βr);
    return s.βr == S(0) || s.φr > o.face_accuracy * o.face_accuracy * scale;
  }
};

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
  static_assert(detail::program_demands<std::remove_cvref_t<QP>>::told);
  static_assert(detail::active_set_demands<std::remove_cvref_t<QP>>::told);

 public:
  using kprgp::proportioning::proportioning;
};

template <class QP>
kprgp(QP&&, kprgp_options<detail::program_scalar_t<QP>> = {}) -> kprgp<kept_t<QP>>;

/// AS-S [K Ex 5], where KPRGP is called AS: KPRGP with the active sets of semismooth Newton: F =
/// blocks with (x − α̃ r)_i inside Λ_i instead of those with x_i inside. [K] states that Theorem 1
/// holds for it as well, and reports it as the stabler one with steps far beyond 2/σ_max.
/// solve(as_s(qp), x0, reduced_gradient_below(1e-6) || at_most(500)).
template <class QP>
[[nodiscard]] auto as_s(QP&& qp, kprgp_options<detail::program_scalar_t<QP>> options = {}) {
  options.semismooth_sets = true;
  return kprgp<kept_t<QP>>(std::forward<QP>(qp), std::move(options));
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
// QPQ [K §3.1.1 Lemma 1, §3.1.4 Table 1], the predecessor of KPRGP: the discontinuous conditions of
// the KKT vector above, φ = 0 and β = 0, decide when a block is released, and −β is the direction:
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
class qpq : public proportioning<QP, kkt_release> {
  static_assert(detail::program_demands<std::remove_cvref_t<QP>>::told);
  static_assert(detail::active_set_demands<std::remove_cvref_t<QP>>::told);

 public:
  using qpq::proportioning::proportioning;
};

template <class QP>
qpq(QP&&, kprgp_options<detail::program_scalar_t<QP>> = {}) -> qpq<kept_t<QP>>;

// --- qpc -----------------------------------------------------------------------------------------
//
// QPC, an active set method of Polyak's type: conjugate gradients minimise q on the face, exactly
// or nearly, before blocks are released from the active set. [T Remark 4.2, Table 4.3] starts
// Newton's method from such a first-order phase, whose algorithm is not printed; this is QPQ that
// releases where ‖φ‖ ≤ δ max(‖φ‖ at the first point of the face, ‖β‖).

/// QPC for a separable_qp: solve(qpc{qp}, x0, reduced_gradient_below(1e-1) || at_most(500)).
/// Requirements, options, statuses and cost are those of qpq.
template <class QP>
class qpc : public proportioning<QP, face_minimum_release> {
  static_assert(detail::program_demands<std::remove_cvref_t<QP>>::told);
  static_assert(detail::active_set_demands<std::remove_cvref_t<QP>>::told);

 public:
  using qpc::proportioning::proportioning;
};

template <class QP>
qpc(QP&&, kprgp_options<detail::program_scalar_t<QP>> = {}) -> qpc<kept_t<QP>>;

}  // namespace slant
