// SPDX-License-Identifier: MIT
//
// Whether every block of a set can be classified.
#pragma once

#include <slant/methods/detail/block_members.hpp>
#include <slant/sets/face.hpp>

namespace slant {

namespace detail {

struct ask_for_states {
  template <class C, class V>
  static constexpr bool of_set = has_own_face<C, V>;
  template <class B, class X>
  static constexpr bool of_block = has_state<B, X>;
};

}  // namespace detail

/// The points of the set have a face: of the set's own kind, or because every block has state(x),
/// as far as its type tells.
template <class C, class V>
concept has_block_states = detail::all_blocks<detail::ask_for_states, C, V>();

}  // namespace slant
