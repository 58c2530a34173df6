// SPDX-License-Identifier: MIT
//
// Lines and numbers of a text file of Gmsh; what is not as expected is refused, naming file and
// line.
#pragma once

#include <charconv>
#include <cmath>
#include <slant/io/text_scanner.hpp>
#include <string>
#include <string_view>
#include <system_error>

namespace fem::detail {

/// slant's scanner of lines and words, with numbers and without blank lines.
class gmsh_scanner : public slant::detail::line_scanner {
  using base = slant::detail::line_scanner;

 public:
  using base::base;

  /// The next line that is not blank; false at the end.
  bool next_line() {
    while (base::next_line())
      if (!is_blank()) return true;
    return false;
  }
  void require_line(std::string_view expectation) {
    if (!next_line()) refuse("the end of the file", expectation);
  }
  /// The next line must be this one.
  void expect_line(std::string_view expected) {
    require_line(expected);
    if (word() != expected || !word().empty()) refuse(slant::detail::quoted(line()), expected);
  }

  /// The next word as a number; nothing else may be in it.
  template <class T>
  T number(std::string_view expectation) {
    std::string_view const text = word();
    char const* const end = text.data() + text.size();
    T value{};
    auto const [rest, error] = std::from_chars(text.data(), end, value);
    if (text.empty() || error != std::errc{} || rest != end)
      refuse(text.empty() ? "the end of the line" : slant::detail::quoted(text), expectation);
    return value;
  }
  /// How many lines follow; a file cannot hold more than its bytes allow.
  slant::index count(std::string_view expectation) {
    require_line(expectation);
    auto const n = number<slant::index>(expectation);
    expect_end_of_line("nothing after the number of lines");
    if (n < 0 || n > bytes_left() / 2)
      refuse(std::to_string(n), "a number of lines that the file can hold");
    return n;
  }
  double coordinate() {
    auto const x = number<double>("a coordinate");
    if (!std::isfinite(x)) refuse(std::to_string(x), "a finite coordinate");
    return x;
  }
};

}  // namespace fem::detail
