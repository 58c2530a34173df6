// SPDX-License-Identifier: MIT
//
// QPC, an active set method of Polyak's type: conjugate gradients minimise q on the face, exactly
// or nearly, before blocks are released from the active set. [T Remark 4.2, Table 4.3] starts
// Newton's method from such a first-order phase, whose algorithm is not printed; this is QPQ with
// another rule:
//
//     ‖φ‖ > δ max(‖φ‖ at the first point of the face, ‖β‖):   conjugate gradient step over F; if it
//                     leaves Λ, a half step to the boundary and the expansion  x ← x − α̃ φ̃
//     otherwise:      x ← x − α β,  α = rᵀβ / βᵀA β or what Λ allows of it
#pragma once

#include <slant/methods/detail/active_set_complaint.hpp>
#include <slant/methods/proportioning.hpp>
#include <slant/methods/release_rules.hpp>

#include <type_traits>

namespace slant {

/// QPC for a separable_qp: solve(qpc{qp}, x0, reduced_gradient_below(1e-1) || at_most(500)).
/// Requirements and statuses are those of kprgp. One application of A a step, two for an expansion.
template <class QP>
class qpc : public proportioning<QP, face_minimum_release> {
  static_assert(detail::active_set_complaint<std::remove_cvref_t<QP>>::made);

 public:
  using qpc::proportioning::proportioning;
};

template <class QP>
qpc(QP&&) -> qpc<kept_t<QP>>;
template <class QP>
qpc(QP&&, qpc_options<typename std::remove_cvref_t<QP>::scalar>) -> qpc<kept_t<QP>>;

}  // namespace slant
