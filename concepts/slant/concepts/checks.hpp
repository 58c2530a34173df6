// SPDX-License-Identifier: MIT
//
// The checks that nearly every constructor makes, and those of the arguments of an application,
// with their sentences in one place.
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/vector.hpp>

#include <string>
#include <string_view>

namespace slant::detail {

/// Throws bad_input "name: got 3, expected 4" (or the expectation in the caller's words).
[[gnu::cold]] inline void check_size(std::string_view name, index got, index expected,
                                     std::string_view meaning = "size") {
  if (got != expected) {
    throw bad_input(name, show(got), std::string(meaning) + " " + show(expected));
  }
}

/// The complaint of check_extent, kept out of the loops that make the check.
[[noreturn, gnu::cold, gnu::noinline]] inline void refuse_extent(char const* name, index got,
                                                                 char const* what, index expected,
                                                                 char const* why) {
  throw bad_input(name, show(got) + " " + what, show(expected) + " (" + why + ")");
}

/// Throws bad_input "y: got 3 rows, expected 4 (rows() of the operator)".
inline void check_extent(char const* name, index got, char const* what, index expected,
                         char const* why) {
  if (got != expected) refuse_extent(name, got, what, expected, why);
}

/// Throws bad_input unless the (local part of the) vector or matrix v has that many rows.
template <class V>
void check_rows(char const* name, V const& v, index expected, char const* why) {
  check_extent(name, index(slant::local(v).rows()), "rows", expected, why);
}

/// Throws bad_input unless there is a result y for each of the arguments x.
template <class X, class Y>
void check_same_columns(char const* name, Y const& y, X const& x, char const* why) {
  check_extent(name, index(slant::local(y).cols()), "columns", index(slant::local(x).cols()), why);
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
