// SPDX-License-Identifier: MIT
//
// Questions about the blocks of a set, asked of its type: members, states, slanting operators,
// inequalities.
#pragma once

#include <slant/concepts/convex_set.hpp>
#include <slant/concepts/proximable.hpp>
#include <slant/sets/blocks.hpp>
#include <slant/sets/face.hpp>

#include <cstddef>
#include <type_traits>
#include <utility>

namespace slant::detail {

// --- block members -------------------------------------------------------------------------------
//
// Whether every block of a set has a member, asked of the type: has_visit cannot tell, for it names
// no block.

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

// --- questions -----------------------------------------------------------------------------------

struct ask_for_states {
  template <class C, class V>
  static constexpr bool of_set = has_own_face<C, V>;
  template <class B, class X>
  static constexpr bool of_block = has_state<B, X>;
};

struct ask_for_slants {
  template <class C, class V>
  static constexpr bool of_set = false;
  /// A block gives a small matrix; a set of any size with one block would have to give a large one.
  template <class B, class X>
  static constexpr bool of_block =
      has_static_dimension<B> && (has_slant<B, X> || has_prox_slant<B, X>);
};

struct ask_for_inequalities {
  template <class C, class V>
  static constexpr bool of_set = false;
  template <class B, class X>
  static constexpr bool of_block =
      has_static_dimension<B> &&
      (has_inequality_form<B, X> || single_point<B>)&&has_step_to_boundary<B, X>;
};

}  // namespace slant::detail

namespace slant {

/// The points of the set have a face: of the set's own kind, or because every block has state(x),
/// as far as its type tells.
template <class C, class V>
concept has_block_states = detail::all_blocks<detail::ask_for_states, C, V>();

/// Every block of the set has slant(x), of a function slant(ρ, z), a matrix of its dimension, as
/// far as its type tells.
template <class C, class V>
concept has_block_slants = detail::all_blocks<detail::ask_for_slants, C, V>();

/// Every block of the set is without constraint, a single point, or has a smooth inequality form
/// and step_to_boundary(x, d), as far as its type tells.
template <class C, class V>
concept has_block_inequalities = detail::all_blocks<detail::ask_for_inequalities, C, V>();

}  // namespace slant
