// SPDX-License-Identifier: MIT
//
// The reduced gradient  r̃(x) = (x − P_Λ(x − α r(x))) / α  of [K (30)]: zero exactly at the solution
// of min q over Λ [K Lemma 2], equal to r where the constraints are not felt.
#pragma once

#include <slant/concepts/convex_set.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/concepts/vector_algebra.hpp>

namespace slant {

/// r̃ at x with gradient r, and on the way trial = x − α r and projected = P_Λ(trial).
template <class Set, class V>
void reduced_gradient(Set const& set, V const& x, V const& r, scalar_t<V> const& α, V& trial,
                      V& projected, V& reduced) {
  vectors::waxpy(-α, r, x, trial);
  slant::project(set, slant::local(trial), slant::local(projected));
  // Where the projection does nothing r̃ = r, exactly: the quotient would lose ‖x‖ε/α.
  auto const& there = slant::local(projected);
  for (index i = 0; i < index(there.size()); ++i) {
    bool const is_inside = there.coeff(i) == slant::local(trial).coeff(i);
    slant::local(reduced).coeffRef(i) =
        is_inside ? slant::local(r).coeff(i)
                  : scalar_t<V>((slant::local(x).coeff(i) - there.coeff(i)) / α);
  }
}

/// r̃ᵀr over some of the blocks, what a projected gradient step on them can gain. On a curved
/// boundary r̃ is nearly orthogonal to r, and close to the solution the product is lost in `noise`,
/// the rounding errors of r̃ times ‖r‖. Then its lower bound ‖r̃‖² stands for it: x ∈ Λ, so (x −
/// P)ᵀ(z − P) ≤ 0 for z = x − α r.
template <class V>
[[nodiscard]] scalar_t<V> gain(V const& reduced, V const& r, scalar_t<V> const& noise) {
  auto const product = inner_product(reduced, r);
  auto const bound = inner_product(reduced, reduced);
  return product > bound + noise ? product : bound;
}

}  // namespace slant
