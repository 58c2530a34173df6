// SPDX-License-Identifier: MIT
//
// Conjugate directions behind a projector [D §4, §5]:
//
//     p ← φ − γ p,   γ = φᵀKq / qᵀKq,   q = Q p,   step length α = rᵀq / qᵀKq
//
// with φ = C r. This is the recurrence for Q C Qᵀ in the place of C, without Qᵀ: that keeps the
// residuals r, which are orthogonal to what Q removes.
#pragma once

#include <slant/krylov/conjugate_directions.hpp>
#include <slant/operators/identity.hpp>

namespace slant {

/// What can stand for Q: an operator that also minimises over range(U).
template <class Q, class V>
concept conjugate_projector_for =
    linear_operator<Q, V> && requires(Q const& q, scalar_t<V> α, V const& b, V& y,
                                      workspace_t<Q, V>& w) { q.add_minimiser(α, b, y, w); };

/// The projector of U without columns: there is nothing to minimise over.
struct no_projector : identity_operator {
  using identity_operator::identity_operator;
  template <class S, class X, class Y, class W>
  void add_minimiser(S const&, X const&, Y&, W&) const {}
};

/// p as in conjugate_directions, q = Q p; Ap is K q and curvature qᵀKq.
template <class V>
struct projected_directions : conjugate_directions<V> {
  V q;  ///< direction of the step

  explicit projected_directions(V const& prototype)
      : conjugate_directions<V>(prototype), q(like(prototype, slant::local(prototype).size())) {}

  /// q, K q and qᵀKq; one application of Q and one of K.
  template <class K, class WK, class Q, class WQ>
  void image(K const& k, WK& k_workspace, Q const& q_operator, WQ& q_workspace) {
    slant::apply(q_operator, this->p, q, q_workspace);
    slant::apply(k, q, this->Ap, k_workspace);
    this->curvature = inner_product(q, this->Ap);
  }
};

}  // namespace slant
