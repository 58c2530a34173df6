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

#include <slant/concepts/linear_operator.hpp>
#include <slant/concepts/vector_algebra.hpp>

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
      : p(like(prototype, slant::local(prototype).size())),
        Ap(like(prototype, slant::local(prototype).size())) {}

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
  template <class A, class W>
  void image(A const& a, W& w) {
    slant::apply(a, p, Ap, w);
    curvature = inner_product(p, Ap);
  }
};

}  // namespace slant
