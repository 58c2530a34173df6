// SPDX-License-Identifier: MIT
//
// A point in the interior of a product of small convex sets, known by nothing but how far one can
// go in them: from any point of a block, go to the middle of the chord along each axis in turn;
// from a chord of infinite length take a piece of the length δ at its end. Two rounds centre a
// ball, a box, and a cone of any opening; in an ellipse, however long, they come to its middle as
// well.
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/checks.hpp>
#include <slant/krylov/unit.hpp>
#include <slant/slanting/detail/inequality_layout.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <limits>
#include <string>
#include <type_traits>

namespace slant {

namespace detail {

/// A point of a block well inside, and how far it is from the boundary along the axes.
template <class X>
struct chord_centre {
  X point;
  typename X::Scalar distance;
};

/// From x in the block, δ > 0 the length of what has none.
template <class Block, class X>
[[nodiscard]] chord_centre<X> centre_by_chords(Block const& block, X const& x,
                                               typename X::Scalar const& δ) {
  using S = typename X::Scalar;
  chord_centre<X> c{x, δ};
  for (int round = 0; round < 3; ++round) {
    c.distance = δ;
    for (index j = 0; j < index(x.size()); ++j) {
      X const axis = X::Unit(x.size(), j);
      S const up = block.step_to_boundary(c.point, axis);
      S const down = block.step_to_boundary(c.point, X(-axis));
      bool const above = is_finite(up), below = is_finite(down);
      S move(0);
      if (above && below) move = (up - down) / S(2);
      if (below && !above) move = std::max<S>(δ - down, S(0));
      if (above && !below) move = std::min<S>(up - δ, S(0));
      c.point(j) += move;
      S const near = std::min<S>(above ? S(up - move) : S(δ), below ? S(down + move) : S(δ));
      c.distance = std::min<S>(c.distance, near);
    }
  }
  return c;
}

[[noreturn]] inline void refuse_empty_interior(index block) {
  throw bad_input("block " + show(block) + " of the set", "an empty interior",
                  "points with f(x) < 0; use slant::point for components with one value, "
                  "slant::free_components for those without bounds, or another method "
                  "(symmetric_newton, kprgp)");
}

}  // namespace detail

/// x ∈ Λ moves the fraction `pull` of the way to the interior; the middle it moves towards goes to
/// `centre`, and 1/σ of every inequality, 0 for those without a bound, to per_unit (see
/// barrier.hpp). Throws bad_input naming a block that has no interior.
template <class C, class V, class R>
void enter_interior(C const& set, scalar_t<V> const& δ, scalar_t<V> const& pull, V& x, V& centre,
                    R& per_unit) {
  using S = scalar_t<V>;
  index row = 0;
  slant::local(centre) = slant::local(x);
  slant::visit_blocks(set, [&](auto const& block, auto const& place) {
    using block_type = std::remove_cvref_t<decltype(block)>;
    constexpr int k = detail::inequalities_of<block_type>;
    if constexpr (k > 0) {
      auto const start = place.value(x);
      auto const c = detail::centre_by_chords(block, start, δ);
      auto const f = block.inequality(c.point).eval();
      for (int i = 0; i < k; ++i) {
        S const depth = -f(i);
        if (!(depth > S(0))) detail::refuse_empty_interior(place.index());
        per_unit(row + i) =
            detail::is_finite(depth) ? S(1) / unit_near(S(depth / c.distance)) : S(0);
      }
      row += k;
      place.put(centre, c.point);
      place.put(x, (start + pull * (c.point - start)).eval());
      if (!(block.inequality(place.value(x)).maxCoeff() < S(0))) place.put(x, c.point);
    }
  });
}

}  // namespace slant
