// SPDX-License-Identifier: MIT
//
// Whether every block of a set has a member, asked of the type: has_visit cannot tell, for it names
// no block.
#pragma once

#include <slant/concepts/convex_set.hpp>
#include <slant/sets/blocks.hpp>

#include <cstddef>
#include <type_traits>
#include <utility>

namespace slant::detail {

template <class Question, class C, class V>
[[nodiscard]] consteval bool all_blocks();

template <class Question, class C, class V, std::size_t... I>
[[nodiscard]] consteval bool all_parts(std::index_sequence<I...>) {
  return (
      all_blocks<Question,
                 std::remove_cvref_t<decltype(std::declval<C const&>().template part<I>())>, V>() &&
      ...);
}

/// Question::of_set<C, V>: is it answered for the whole set already? Question::of_block<B, X>: does
/// a block B have what is asked for at points X? Powers tell their block_type, products the number
/// and types of their parts, images their part.
template <class Question, class C, class V>
consteval bool all_blocks() {
  if constexpr (Question::template of_set<C, V>) {
    return true;
  } else if constexpr (!has_visit<C> && has_static_dimension<C>) {
    return whole_space<C> || Question::template of_block<C, point_t<C>>;
  } else if constexpr (!has_visit<C>) {
    return Question::template of_block<C, V>;
  } else if constexpr (requires { typename C::block_type; }) {
    return all_blocks<Question, typename C::block_type, V>();
  } else if constexpr (requires { C::part_count; }) {
    return all_parts<Question, C, V>(std::make_index_sequence<C::part_count>{});
  } else if constexpr (requires(C const& c) { c.part(); }) {
    return all_blocks<Question, std::remove_cvref_t<decltype(std::declval<C const&>().part())>,
                      V>();
  } else {
    return true;  // a client's product, which need not tell: whoever visits it looks at each block
  }
}

}  // namespace slant::detail
