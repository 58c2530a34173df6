// SPDX-License-Identifier: MIT
//
// Does a plane separate the set Λ from the affine space { Q x = x̄ }? Every point z of the space has
// wᵀz = wᵀx̄ if w ∈ range Q; so none is in Λ if wᵀy > wᵀx̄ for all y ∈ Λ. The least value of wᵀy is
// approached by
//
//     y(t) = P_Λ(x − t w),     t = 1, 2, 4, …,
//
// the minimisers of wᵀy + ‖y − x‖²/(2t), for w = Q x − x̄, the way from the space to x. The answer
// is yes only if the plane lies between the space and all y(t) until y(t) stays where it is, or up
// to t = 2⁴⁰: no point of Λ within that many times the distance ‖w‖ is in the space then.
#pragma once

#include <slant/concepts/convex_set.hpp>
#include <slant/concepts/vector.hpp>

#include <limits>

namespace slant::detail {

/// y and projected are scratch of the size of x. Mostly the first few t say no.
template <class Set, class V>
[[nodiscard]] bool separates(Set const& set, V const& x, V const& w, V const& nearest, V& y,
                             V& projected) {
  using S = scalar_t<V>;
  S const distance = norm(w);
  S last = std::numeric_limits<S>::infinity();
  S t(1);
  for (int k = 0; k <= 40; ++k, t *= S(2)) {
    slant::local(y) = slant::local(x) - t * slant::local(w);
    slant::project(set, slant::local(y), slant::local(projected));
    slant::local(y) = (slant::local(projected) - slant::local(nearest)) * (S(1) / distance);
    S const size = distance * norm(y);
    S const height = inner_product(w, y);
    if (!(height > S(256) * std::numeric_limits<S>::epsilon() * size)) return false;
    slant::local(y) = slant::local(projected) - slant::local(x);
    S const moved = norm(y);
    if (moved == last) return true;
    last = moved;
  }
  return true;
}

}  // namespace slant::detail
