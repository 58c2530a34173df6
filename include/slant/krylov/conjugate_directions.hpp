// SPDX-License-Identifier: MIT
//
// The recurrence that all conjugate gradient methods here share [K (31), (32)]:
//
//     p = φ at a restart, then   p ← φ − γ p,   γ = φᵀAp / pᵀAp,
//     step length                α = rᵀp / pᵀAp.
//
// γ is taken from Ap, not from a quotient of residual norms: it keeps p conjugate to its
// predecessor when the residual was recomputed or the preconditioner changed in between.
#pragma once

#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/linear_operator.hpp>
#include <slant/operators/identity.hpp>

namespace slant {

/// The current direction p with its image Ap and its curvature pᵀAp.
template <class V>
struct conjugate_directions {
  using scalar = scalar_t<V>;

  V p;                  ///< direction
  V Ap;                 ///< its image
  scalar curvature{0};  ///< pᵀAp
  bool live = false;    ///< p continues a sequence; false: the next one is a restart

  explicit conjugate_directions(V const& prototype)
      : p(like(prototype, slant::local(prototype).size())), Ap(p) {}

  /// Next direction from the (preconditioned, projected) gradient φ.
  void advance(V const& φ) {
    if (live) {
      scalar const γ = inner_product(φ, Ap) / curvature;
      vectors::waxpy(-γ, p, φ, p);
    } else {
      vectors::copy(φ, p);
      live = true;
    }
  }

  /// Ap and pᵀAp; one application of A.
  void image(auto const& a, auto& w) {
    slant::apply(a, p, Ap, w);
    curvature = inner_product(p, Ap);
  }
};

// --- projected directions ------------------------------------------------------------------------
//
// Conjugate directions behind a projector [D §4, §5]:
//
//     p ← φ − γ p,   γ = φᵀKq / qᵀKq,   q = Q p,   step length α = rᵀq / qᵀKq
//
// with φ = C r. This is the recurrence for Q C Qᵀ in the place of C, without Qᵀ: that keeps the
// residuals r, which are orthogonal to what Q removes.

/// What can stand for Q: an operator that also minimises over range(U).
template <class Q, class V>
concept conjugate_projector_for =
    linear_operator<Q, V> && requires(Q const& q, scalar_t<V> α, V const& b, V& y,
                                      workspace_t<Q, V>& w) { q.add_minimiser(α, b, y, w); };

/// The projector of U without columns: there is nothing to minimise over.
struct no_projector : identity_operator {
  using identity_operator::identity_operator;
  void add_minimiser(auto const&, auto const&, auto&, auto&) const {}
};

/// p as in conjugate_directions, q = Q p; Ap is K q and curvature qᵀKq.
template <class V>
struct projected_directions : conjugate_directions<V> {
  V q;  ///< direction of the step

  explicit projected_directions(V const& prototype)
      : conjugate_directions<V>(prototype), q(this->p) {}

  /// q, K q and qᵀKq; one application of Q and one of K.
  void image(auto const& k, auto& k_workspace, auto const& q_operator, auto& q_workspace) {
    slant::apply(q_operator, this->p, q, q_workspace);
    slant::apply(k, q, this->Ap, k_workspace);
    this->curvature = inner_product(q, this->Ap);
  }
};

}  // namespace slant
