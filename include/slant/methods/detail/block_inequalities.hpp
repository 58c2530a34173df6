// SPDX-License-Identifier: MIT
//
// Whether a set is known block by block by smooth inequalities.
#pragma once

#include <slant/methods/detail/block_members.hpp>

namespace slant {

namespace detail {

struct ask_for_inequalities {
  template <class C, class V>
  static constexpr bool of_set = false;
  template <class B, class X>
  static constexpr bool of_block =
      has_static_dimension<B> &&
      (has_inequality_form<B, X> || single_point<B>)&&has_step_to_boundary<B, X>;
};

}  // namespace detail

/// Every block of the set is without constraint, a single point, or has a smooth inequality form
/// and step_to_boundary(x, d), as far as its type tells.
template <class C, class V>
concept has_block_inequalities = detail::all_blocks<detail::ask_for_inequalities, C, V>();

}  // namespace slant
