// SPDX-License-Identifier: MIT
//
// Whether every block of a set can be classified, asked of the type: has_visit cannot tell, for it
// names no block.
#pragma once

#include <slant/concepts/convex_set.hpp>
#include <slant/sets/blocks.hpp>
#include <slant/sets/face.hpp>

#include <cstddef>
#include <type_traits>
#include <utility>

namespace slant {

namespace detail {

template <class C, class V>
[[nodiscard]] consteval bool blocks_have_states();

template <class C, class V, std::size_t... I>
[[nodiscard]] consteval bool parts_have_states(std::index_sequence<I...>) {
  return (
      blocks_have_states<std::remove_cvref_t<decltype(std::declval<C const&>().template part<I>())>,
                         V>() &&
      ...);
}

/// A set with faces of its own has them. Powers tell their block_type, products the number and
/// types of their parts, images their part.
template <class C, class V>
consteval bool blocks_have_states() {
  if constexpr (has_own_face<C, V>) {
    return true;
  } else if constexpr (!has_visit<C> && has_static_dimension<C>) {
    return whole_space<C> || has_state<C, point_t<C>>;
  } else if constexpr (!has_visit<C>) {
    return has_state<C, V>;
  } else if constexpr (requires { typename C::block_type; }) {
    return blocks_have_states<typename C::block_type, V>();
  } else if constexpr (requires { C::part_count; }) {
    return parts_have_states<C, V>(std::make_index_sequence<C::part_count>{});
  } else if constexpr (requires(C const& c) { c.part(); }) {
    return blocks_have_states<std::remove_cvref_t<decltype(std::declval<C const&>().part())>, V>();
  } else {
    return true;  // a client's product, which need not tell: slant::face looks at each block
  }
}

}  // namespace detail

/// The points of the set have a face: of the set's own kind, or because every block has state(x),
/// as far as its type tells.
template <class C, class V> concept has_block_states = detail::blocks_have_states<C, V>();

}  // namespace slant
