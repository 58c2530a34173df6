// SPDX-License-Identifier: MIT
//
// The member `inequalities` of a set made from other sets: there only if all of them have it.
#pragma once

#include <slant/sets/blocks.hpp>

namespace slant::detail {

template <class... Parts>
inline constexpr bool all_smooth = (has_inequality_form<Parts, point_t<Parts>> && ...);

struct no_inequality_form {};

template <class... Parts>
struct inequality_form {
  /// Number of smooth inequalities f_i(x) <= 0 that describe the set.
  static constexpr int inequalities = (Parts::inequalities + ...);
};

template <class... Parts>
[[nodiscard]] consteval auto inequality_form_of() {
  if constexpr (all_smooth<Parts...>) {
    return inequality_form<Parts...>{};
  } else {
    return no_inequality_form{};
  }
}

/// Base class that has `inequalities`, or nothing.
template <class... Parts>
using inequality_count = decltype(inequality_form_of<Parts...>());

}  // namespace slant::detail
