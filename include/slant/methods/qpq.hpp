// SPDX-License-Identifier: MIT
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
#pragma once

#include <slant/methods/detail/active_set_complaint.hpp>
#include <slant/methods/proportioning.hpp>
#include <slant/methods/release_rules.hpp>

#include <type_traits>

namespace slant {

/// QPQ for a separable_qp: solve(qpq{qp}, x0, reduced_gradient_below(1e-6) || at_most(500)).
/// Requirements, options and statuses are those of kprgp. One application of A a step, two for an
/// expansion.
template <class QP>
class qpq : public proportioning<QP, kkt_proportioning> {
  static_assert(detail::active_set_complaint<std::remove_cvref_t<QP>>::made);

 public:
  using qpq::proportioning::proportioning;
};

template <class QP>
qpq(QP&&) -> qpq<kept_t<QP>>;
template <class QP>
qpq(QP&&, kprgp_options<typename std::remove_cvref_t<QP>::scalar>) -> qpq<kept_t<QP>>;

}  // namespace slant
