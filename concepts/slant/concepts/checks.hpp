// SPDX-License-Identifier: MIT
//
// The two checks that nearly every constructor makes, with their sentences in one place.
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/vector.hpp>

#include <string>
#include <string_view>

namespace slant::detail {

/// Throws bad_input "name: got 3, expected 4" (or the expectation in the caller's words).
inline void check_size(std::string_view name, index got, index expected,
                       std::string_view meaning = "size") {
  if (got != expected) {
    throw bad_input(name, show(got), std::string(meaning) + " " + show(expected));
  }
}

/// Throws bad_input "name[7]: got nan, expected a finite number" for the first offending entry.
template <class V>
void check_finite(std::string_view name, V const& v) {
  using S = scalar_t<V>;
  auto const& entries = slant::local(v);
  for (index i = 0; i < index(entries.size()); ++i) {
    S const e = entries.coeff(i);
    if (!is_finite(e)) {
      throw bad_input(std::string(name) + "[" + show(i) + "]", show(e), "a finite number");
    }
  }
}

}  // namespace slant::detail
