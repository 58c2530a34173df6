// SPDX-License-Identifier: MIT
//
// The optimality conditions of [K Lemma 1], from which KPRGP's predecessors took their release
// directions: x ∈ Λ solves min q over Λ exactly if r_i = 0 where f_i(x_i) < 0 and
//
//     β_i = r_i + (‖r_i‖ / ‖∇f_i(x_i)‖) ∇f_i(x_i) = 0   where f_i(x_i) = 0.
//
// −β_i halves the angle between the directions that leave Λ_i and those in which q rises. Unlike
// the reduced gradient, β is discontinuous: just inside the boundary r_i stands for it, small or
// not.
#pragma once

#include <slant/concepts/convex_set.hpp>
#include <slant/concepts/face.hpp>
#include <slant/sets/face.hpp>

#include <Eigen/Core>

#include <cmath>

namespace slant {

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

}  // namespace slant
