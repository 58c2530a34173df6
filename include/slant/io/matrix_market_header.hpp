// SPDX-License-Identifier: MIT
//
// The first lines of a Matrix Market file: what it holds, and how much. Nothing is allocated for
// sizes that the bytes of the file could not back.
#pragma once

#include <algorithm>
#include <charconv>
#include <concepts>
#include <limits>
#include <slant/io/text_scanner.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace slant {

struct matrix_market_options {
  /// Empty rows and columns cost memory but no bytes of the file, so a short file could claim any
  /// number of them: more than this many are believed only if the file has as many bytes.
  index unbacked_dimension = index{1} << 24;
};

namespace detail {

struct matrix_market_header {
  bool array = false, pattern = false, integer = false, symmetric = false;
  index rows = 0, cols = 0;
  index entries = 0;  ///< stored in the file, not expanded
};

[[nodiscard, gnu::cold]] inline std::string lower_case(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if ('A' <= c && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

/// The next word of the banner; one of those accepted, in any letter case.
inline std::string banner_word(line_scanner& lines, std::vector<std::string_view> const& accepted,
                               std::string_view expectation) {
  std::string_view const word = lines.word();
  std::string lower = lower_case(word);
  if (std::find(accepted.begin(), accepted.end(), lower) == accepted.end())
    lines.refuse(quoted(word), expectation);
  return lower;
}

[[nodiscard]] inline matrix_market_header parse_banner(line_scanner& lines) {
  matrix_market_header header;
  // The format has %%; collections in use also have %, which is as clear and cannot be a number.
  std::string_view const mark = lines.next_line() ? lines.word() : std::string_view{};
  if (mark != "%%MatrixMarket" && mark != "%MatrixMarket")
    lines.refuse(quoted(lines.line()),
                 "a first line like '%%MatrixMarket matrix coordinate real general'");
  banner_word(lines, {"matrix"}, "the object 'matrix'");
  header.array = banner_word(lines, {"coordinate", "array"}, "coordinate or array") == "array";
  std::string const field =
      banner_word(lines, {"real", "integer", "pattern"},
                  "real, integer or pattern (complex matrices are not supported)");
  header.integer = field == "integer";
  header.pattern = field == "pattern";
  if (header.array && header.pattern)
    lines.refuse("'array pattern'", "real or integer in an array");
  header.symmetric =
      banner_word(lines, {"general", "symmetric"},
                  "general or symmetric (skew-symmetric and hermitian are not supported)") ==
      "symmetric";
  lines.expect_end_of_line("nothing after the symmetry");
  return header;
}

/// A whole number of [least, most]; what it is goes into the message.
[[nodiscard]] inline index parse_count(line_scanner& lines, index least, index most,
                                       std::string_view what) {
  std::string_view const word = lines.word();
  index value = 0;
  auto const [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  bool const whole = end == word.data() + word.size() && error != std::errc::invalid_argument;
  if (!whole || error != std::errc{} || value < least || value > most)
    lines.refuse(word.empty() ? "the end of the line" : quoted(word),
                 std::string(what) + " from " + show(least) + " to " + show(most));
  return value;
}

/// Comments, then the size line. Nothing has been allocated yet; afterwards every number in the
/// header is one that the bytes of the file can back.
template <std::signed_integral I>
void parse_sizes(line_scanner& lines, matrix_market_header& header,
                 matrix_market_options const& options) {
  do {
    if (!lines.next_line()) lines.refuse("the end of the file", "a line with the sizes");
  } while (lines.is_blank() || lines.line().starts_with('%'));

  auto const storable = static_cast<index>(std::numeric_limits<I>::max()) - 1;
  index const bytes = lines.bytes_left();
  index const most = std::min(storable, std::max(options.unbacked_dimension, bytes));
  header.rows = parse_count(lines, 0, most, "a number of rows");
  header.cols = parse_count(lines, 0, most, "a number of columns");
  if (header.symmetric && header.rows != header.cols)
    lines.refuse(show(header.rows) + " rows and " + show(header.cols) + " columns",
                 "a square matrix, since it is symmetric");

  // The shortest lines are "1 1 1", "1 1" and "1", each with its line feed.
  index const shortest = header.array ? 2 : header.pattern ? 4 : 6;
  index const rows = header.rows, cols = header.cols;
  bool const cells_overflow = rows > 0 && cols > std::numeric_limits<index>::max() / (rows + 1);
  index const cells = cells_overflow     ? std::numeric_limits<index>::max()
                      : header.symmetric ? rows * (rows + 1) / 2
                                         : rows * cols;
  index const room = bytes / shortest;
  header.entries = header.array ? cells : parse_count(lines, 0, cells, "a number of entries");
  if (header.entries > room)
    lines.refuse(show(header.entries) + " entries", "at most " + show(room) +
                                                        ", all that the remaining " + show(bytes) +
                                                        " bytes can hold (truncated file?)");
  lines.expect_end_of_line("nothing more on the line with the sizes");
}

}  // namespace detail
}  // namespace slant
