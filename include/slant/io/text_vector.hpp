// SPDX-License-Identifier: MIT
//
// Vectors as text: one number per line, as written by numpy.savetxt, MATLAB's writematrix or hand.
//
// Lines that begin with # are comments; blank lines are allowed only after the last number. Every
// line, the last one too, ends in a line feed (why: see text_scanner.hpp). A file that lost whole
// lines at its end is noticed only if the caller says how many numbers it expects.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <concepts>
#include <filesystem>
#include <optional>
#include <slant/io/atomic_file.hpp>
#include <slant/io/text_scanner.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace slant {

struct text_vector_options {
  std::optional<index> size{};  ///< how many numbers there must be
  bool allow_infinity = false;  ///< accept inf, +inf, -inf, infinity in any letter case
};

namespace detail {

/// +1 or -1 for a spelling of infinity, else 0.
[[nodiscard]] inline int sign_of_infinity(std::string_view word) {
  int const sign = word.starts_with('-') ? -1 : 1;
  if (word.starts_with('-') || word.starts_with('+')) word.remove_prefix(1);
  std::string const lower = lower_case(word);
  return lower == "inf" || lower == "infinity" ? sign : 0;
}

template <std::floating_point S>
[[nodiscard]] S parse_component(line_scanner& lines, bool allow_infinity) {
  std::string_view const word = lines.word();
  S value{};
  number_defect const defect = parse_number(word, value);
  if (defect != number_defect::none) {
    int const sign = allow_infinity ? sign_of_infinity(word) : 0;
    if (sign == 0)
      lines.refuse(quoted(word), allow_infinity && defect == number_defect::not_a_number
                                     ? "a number or inf"
                                     : expectation_of(defect));
    value = static_cast<S>(sign) * std::numeric_limits<S>::infinity();
  }
  lines.expect_end_of_line("one number per line");
  return value;
}

}  // namespace detail

/// The vector in a text of one number per line; file names it in messages.
/// Throws bad_input naming file, line, value and expectation.
template <std::floating_point S = double>
[[nodiscard]] Eigen::VectorX<S> parse_text_vector(std::string_view text, std::string file,
                                                  text_vector_options const& options = {}) {
  detail::line_scanner lines(text, std::move(file));
  std::vector<S> values;
  index blank_line = 0;
  while (lines.next_line()) {
    if (lines.is_blank()) {
      if (blank_line == 0) blank_line = lines.line_number();
      continue;
    }
    if (auto peek = lines; peek.word().starts_with('#')) continue;
    if (blank_line != 0)
      lines.refuse(
          detail::quoted(lines.line()) + " after the blank line " + detail::show(blank_line),
          "blank lines only at the end");
    values.push_back(detail::parse_component<S>(lines, options.allow_infinity));
    if (options.size && static_cast<index>(values.size()) > *options.size)
      lines.refuse("number " + detail::show(values.size()),
                   detail::show(*options.size) + " numbers");
  }
  auto const count = static_cast<index>(values.size());
  if (options.size && count != *options.size)
    lines.refuse("the end of the file after " + detail::show(count) + " numbers",
                 detail::show(*options.size) + " numbers");
  return Eigen::Map<Eigen::VectorX<S> const>(values.data(), count);
}

/// Reads a vector from a file. Throws bad_input.
template <std::floating_point S = double>
[[nodiscard]] Eigen::VectorX<S> read_text_vector(std::filesystem::path const& path,
                                                 text_vector_options const& options = {}) {
  return parse_text_vector<S>(detail::read_text_file(path), detail::printable(path), options);
}

/// Writes a vector so that reading it gives the same bits; an empty file is not read. Throws
/// bad_input for NaN (and for infinity unless allowed), which no reader would accept;
/// std::system_error if there is no room.
template <class Vector>
void write_text_vector(atomic_file& file, Eigen::MatrixBase<Vector> const& x,
                       text_vector_options const& options = {}) {
  static_assert(Vector::ColsAtCompileTime == 1, "write_text_vector: a column vector");
  std::string text;
  for (index i = 0; i < x.size(); ++i) {
    auto const value = x[i];
    if (std::isnan(value) || (std::isinf(value) && !options.allow_infinity))
      throw bad_input(detail::printable(file.target()),
                      detail::show(value) + " in component " + detail::show(i), "finite numbers");
    detail::append_number(text, value);
    text += '\n';
  }
  file.write(text);
}

/// The same as a file of its own, which appears complete or not at all.
template <class Vector>
void write_text_vector(std::filesystem::path const& path, Eigen::MatrixBase<Vector> const& x,
                       text_vector_options const& options = {}) {
  atomic_file file(path);
  write_text_vector(file, x, options);
  file.commit();
}

}  // namespace slant
