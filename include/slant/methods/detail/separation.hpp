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
//
// The right w is the one at the point of Λ next to the space, which minimises ½ ‖Q x − x̄‖² over Λ:
// accelerated projected gradients find it, at the price of a projection onto both a step.
#pragma once

#include <slant/concepts/convex_set.hpp>
#include <slant/concepts/linear_operator.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/concepts/vector_algebra.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

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
    vectors::waxpy(-t, w, x, y);
    slant::project(set, slant::local(y), slant::local(projected));
    vectors::difference(projected, nearest, y);
    vectors::scale(S(1) / distance, y);
    S const size = distance * norm(y);
    S const height = inner_product(w, y);
    if (!(height > S(256) * std::numeric_limits<S>::epsilon() * size)) return false;
    vectors::difference(projected, x, y);
    S const moved = norm(y);
    if (moved == last) return true;
    last = moved;
  }
  return true;
}

/// Is it shown that no point of Λ is in the space c? Starts at x. Allocates.
template <class Set, class C, class V>
[[nodiscard]] bool is_apart(Set const& set, C const& c, V const& x) {
  using S = scalar_t<V>;
  V point = x, last = x, ahead = x, w = x, y = x, projected = x;
  auto const Q = c.range_projector();
  S shortest = std::numeric_limits<S>::infinity();
  index momentum = 0;
  for (index k = 1; k <= 4096; ++k) {
    slant::apply(Q, ahead, w);
    vectors::subtract(c.nearest(), w);
    vectors::difference(ahead, w, y);
    std::swap(last, point);
    slant::project(set, slant::local(y), slant::local(point));
    slant::apply(Q, point, w);
    vectors::subtract(c.nearest(), w);
    S const distance = norm(w);
    using std::sqrt;
    if (!(distance > sqrt(std::numeric_limits<S>::epsilon()) * norm(point))) return false;
    if ((k & (k - 1)) == 0 && separates(set, point, w, c.nearest(), y, projected)) return true;
    momentum = distance > shortest ? 0 : momentum + 1;
    shortest = std::min(shortest, distance);
    S const factor = S(static_cast<double>(momentum)) / S(static_cast<double>(momentum + 3));
    slant::local(ahead) = slant::local(point) + factor * (slant::local(point) - slant::local(last));
  }
  return false;
}

}  // namespace slant::detail
