// SPDX-License-Identifier: MIT
//
// Whether the slanting operator of the projection onto a set is known block by block.
#pragma once

#include <slant/methods/detail/block_members.hpp>

namespace slant {

namespace detail {

struct ask_for_slants {
  template <class C, class V>
  static constexpr bool of_set = false;
  /// A block gives a small matrix; a set of any size with one block would have to give a large one.
  template <class B, class X>
  static constexpr bool of_block = has_static_dimension<B> && has_slant<B, X>;
};

}  // namespace detail

/// Every block of the set has slant(x), a matrix of its dimension, as far as its type tells.
template <class C, class V>
concept has_block_slants = detail::all_blocks<detail::ask_for_slants, C, V>();

}  // namespace slant
