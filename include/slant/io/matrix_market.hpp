// SPDX-License-Identifier: MIT
//
// Reads sparse matrices in Matrix Market format: coordinate or array, real or integer, or a pattern
// of ones (coordinate only), general or symmetric (the lower triangle is stored).
//
// Why our own. We tried what Debian 12 ships on damaged files. Eigen 3.4 (loadMarket) reads a file
// with two of its four entries missing, with text in place of a number, with NaN, and reports
// success. CHOLMOD 3.0 notices the missing entries, but takes NaN, 1e999 as infinity, ignores extra
// lines and sums what is given twice. Here every defect is refused with its line.
//
// Stricter than the format asks: an entry given twice is refused, not summed, for it is as often a
// mistake as a sum; and every line, the last one too, ends in a line feed (see text_scanner.hpp).
#pragma once

#include <Eigen/SparseCore>
#include <concepts>
#include <filesystem>
#include <limits>
#include <map>
#include <slant/io/matrix_market_header.hpp>
#include <slant/io/number_text.hpp>
#include <slant/io/text_scanner.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace slant {

namespace detail {

template <std::floating_point S>
[[nodiscard]] S parse_entry(line_scanner& lines, bool integer) {
  std::string_view const word = lines.word();
  S value{};
  number_defect const defect = parse_number(word, value);
  if (defect != number_defect::none)
    lines.refuse(word.empty() ? "the end of the line" : quoted(word), expectation_of(defect));
  if (integer && !split_decimal(word).integer)
    lines.refuse(quoted(word), "a whole number, since the field is integer");
  return value;
}

/// The next line with an entry.
inline void next_entry(line_scanner& lines, index read, matrix_market_header const& header) {
  do {
    if (!lines.next_line())
      lines.refuse("the end of the file after " + show(read) + " entries",
                   show(header.entries) + " entries");
  } while (lines.is_blank());
}

/// Row and column of an entry, from 0.
[[nodiscard]] inline std::pair<index, index> parse_position(line_scanner& lines,
                                                            matrix_market_header const& header) {
  index const row = parse_count(lines, 1, header.rows, "a row");
  index const col = parse_count(lines, 1, header.cols, "a column");
  if (header.symmetric && row < col)
    lines.refuse("row " + show(row) + ", column " + show(col),
                 "only entries on or below the diagonal, since it is symmetric");
  return {row - 1, col - 1};
}

/// Called once it is known that an entry is there twice, to find its line.
[[noreturn]] inline void refuse_duplicate(line_scanner lines, matrix_market_header const& header) {
  std::map<std::pair<index, index>, index> seen;
  for (index k = 0;; ++k) {
    next_entry(lines, k, header);
    auto const position = parse_position(lines, header);
    auto const [first, is_new] = seen.try_emplace(position, lines.line_number());
    if (!is_new)
      lines.refuse(
          "row " + show(position.first + 1) + ", column " + show(position.second + 1) + " again",
          "each entry once (first on line " + show(first->second) + ")");
  }
}

/// The entries of a coordinate file; the mirrored ones too if it is symmetric.
template <std::floating_point S, std::signed_integral I>
[[nodiscard]] std::vector<Eigen::Triplet<S, I>> parse_coordinates(
    line_scanner& lines, matrix_market_header const& header) {
  std::vector<Eigen::Triplet<S, I>> entries;
  entries.reserve(static_cast<std::size_t>(header.entries) * (header.symmetric ? 2 : 1));
  for (index k = 0; k < header.entries; ++k) {
    next_entry(lines, k, header);
    auto const [row, col] = parse_position(lines, header);
    S const value = header.pattern ? S(1) : parse_entry<S>(lines, header.integer);
    lines.expect_end_of_line("nothing after the entry");
    entries.emplace_back(static_cast<I>(row), static_cast<I>(col), value);
    if (header.symmetric && row != col)
      entries.emplace_back(static_cast<I>(col), static_cast<I>(row), value);
  }
  return entries;
}

/// The numbers of an array file, column by column; zeros are not kept.
template <std::floating_point S, std::signed_integral I>
[[nodiscard]] std::vector<Eigen::Triplet<S, I>> parse_array(line_scanner& lines,
                                                            matrix_market_header const& header) {
  std::vector<Eigen::Triplet<S, I>> entries;
  index read = 0;
  for (index col = 0; col < header.cols; ++col)
    for (index row = header.symmetric ? col : 0; row < header.rows; ++row) {
      next_entry(lines, read++, header);
      S const value = parse_entry<S>(lines, header.integer);
      lines.expect_end_of_line("one number per line in an array");
      if (value == 0) continue;
      entries.emplace_back(static_cast<I>(row), static_cast<I>(col), value);
      if (header.symmetric && row != col)
        entries.emplace_back(static_cast<I>(col), static_cast<I>(row), value);
    }
  return entries;
}

}  // namespace detail

/// The matrix in a Matrix Market text; file names it in messages. Each number is rounded to the
/// nearest S; explicit zeros of a coordinate file stay in the pattern; symmetric matrices have both
/// triangles. Throws bad_input naming file, line, value and expectation.
template <std::floating_point S = double, std::signed_integral I = int>
[[nodiscard]] Eigen::SparseMatrix<S, Eigen::ColMajor, I> parse_matrix_market(
    std::string_view text, std::string file, matrix_market_options const& options = {}) {
  detail::line_scanner lines(text, std::move(file));
  detail::matrix_market_header header = detail::parse_banner(lines);
  detail::parse_sizes<I>(lines, header, options);

  detail::line_scanner const at_entries = lines;
  auto const entries = header.array ? detail::parse_array<S, I>(lines, header)
                                    : detail::parse_coordinates<S, I>(lines, header);
  while (lines.next_line())
    if (!lines.is_blank())
      lines.refuse(detail::quoted(lines.line()),
                   "the end of the file after " + detail::show(header.entries) + " entries");
  if (entries.size() > static_cast<std::size_t>(std::numeric_limits<I>::max()))
    lines.refuse(detail::show(entries.size()) + " entries with their mirror images",
                 "at most " + detail::show(std::numeric_limits<I>::max()));

  Eigen::SparseMatrix<S, Eigen::ColMajor, I> matrix(header.rows, header.cols);
  bool twice = false;
  matrix.setFromTriplets(entries.begin(), entries.end(), [&](S const& a, S const&) {
    twice = true;
    return a;
  });
  if (twice) detail::refuse_duplicate(at_entries, header);
  return matrix;
}

/// Reads a matrix from a Matrix Market file. Throws bad_input.
template <std::floating_point S = double, std::signed_integral I = int>
[[nodiscard]] Eigen::SparseMatrix<S, Eigen::ColMajor, I> read_matrix_market(
    std::filesystem::path const& path, matrix_market_options const& options = {}) {
  return parse_matrix_market<S, I>(detail::read_text_file(path), detail::printable(path), options);
}

}  // namespace slant
