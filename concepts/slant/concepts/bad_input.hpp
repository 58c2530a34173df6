// SPDX-License-Identifier: MIT
//
// The one exception for data that a caller got wrong. It names the argument, its value and what was
// expected. Trouble that arises while computing is never an exception: it is a status in the
// report.
#pragma once

#include <slant/concepts/vector.hpp>

#include <charconv>
#include <cstddef>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

namespace slant {

namespace detail {

/// Text of anything that can be streamed; of a floating-point number the shortest that means it.
template <class T>
[[nodiscard, gnu::cold]] std::string show(T const& value) {
  if constexpr (std::is_floating_point_v<T>) {
    char text[64];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
  } else {
    std::ostringstream out;
    out.precision(17);
    out << value;
    return out.str();
  }
}

/// Text of a measured number, such as an error or seconds: three digits of it.
template <class T>
[[nodiscard, gnu::cold]] std::string brief(T const& value) {
  if constexpr (std::is_floating_point_v<T>) {
    char text[64];
    return {text,
            std::to_chars(text, text + sizeof text, value, std::chars_format::general, 3).ptr};
  } else {
    std::ostringstream out;
    out.precision(3);
    out << value;
    return out.str();
  }
}

}  // namespace detail

/// Thrown at construction or at the start of a run when an argument cannot be used.
/// what() reads "radius: got -1, expected a number >= 0".
class bad_input : public std::invalid_argument {
 public:
  [[gnu::cold]] bad_input(std::string_view argument, std::string_view value,
                          std::string_view expectation)
      : std::invalid_argument(std::string(argument)
                                  .append(": got ")
                                  .append(value)
                                  .append(", expected ")
                                  .append(expectation)),
        name_length_(argument.size()) {}

  /// The same complaint about entry i of an array of such arguments: "radius[3]: got -1, …".
  [[nodiscard, gnu::cold]] bad_input at(std::ptrdiff_t i) const {
    std::string_view const text = what();
    std::string changed(text.substr(0, name_length_));
    changed.append("[").append(detail::show(i)).append("]");
    std::size_t const length = changed.size();
    changed.append(text.substr(name_length_));
    return {changed, length};
  }

 private:
  bad_input(std::string const& text, std::size_t name_length)
      : std::invalid_argument(text), name_length_(name_length) {}

  std::size_t name_length_;
};

}  // namespace slant

namespace slant::detail {

/// Throws bad_input "name: got 3, expected 4" (or the expectation in the caller's words).
[[gnu::cold]] inline void check_size(std::string_view name, index got, index expected,
                                     std::string_view meaning = "size") {
  if (got != expected) {
    throw bad_input(name, show(got), std::string(meaning) + " " + show(expected));
  }
}

/// Throws bad_input unless the option `holds` what is expected; check_positive: a finite number
/// > 0; check_fraction: one in (0, 1).
template <class T>
[[gnu::cold]] void check_option(std::string_view name, T const& value, bool holds,
                                std::string_view expectation) {
  if (!holds) throw bad_input(name, show(value), expectation);
}
template <class T>
[[gnu::cold]] void check_positive(std::string_view name, T const& value) {
  check_option(name, value, value > T(0) && is_finite(value), "a finite number > 0");
}
template <class T>
[[gnu::cold]] void check_fraction(std::string_view name, T const& value) {
  check_option(name, value, value > T(0) && value < T(1), "a number in (0, 1)");
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
void check_rows(char const* name, auto const& v, index expected, char const* why) {
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
    if (!is_finite(e)) throw bad_input(name, show(e), "a finite number").at(i);
  }
}

}  // namespace slant::detail
