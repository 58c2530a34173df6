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

#include <slant/io/atomic_file.hpp>
#include <slant/io/text_scanner.hpp>

#include <Eigen/SparseCore>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <concepts>
#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace slant {

// --- header --------------------------------------------------------------------------------------

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

  // The shortest lines are "1 1 1", "1 1" and "1", each with its line feed, but for the last one.
  index const shortest = header.array ? 2 : header.pattern ? 4 : 6;
  index const rows = header.rows, cols = header.cols;
  bool const cells_overflow = rows > 0 && cols > std::numeric_limits<index>::max() / (rows + 1);
  index const cells = cells_overflow     ? std::numeric_limits<index>::max()
                      : header.symmetric ? rows * (rows + 1) / 2
                                         : rows * cols;
  index const room = (bytes + 1) / shortest;
  header.entries = header.array ? cells : parse_count(lines, 0, cells, "a number of entries");
  if (header.entries > room)
    lines.refuse(show(header.entries) + " entries", "at most " + show(room) +
                                                        ", all that the remaining " + show(bytes) +
                                                        " bytes can hold (truncated file?)");
  lines.expect_end_of_line("nothing more on the line with the sizes");
}

// --- matrix market -------------------------------------------------------------------------------

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

/// The entries, the mirrored ones too if it is symmetric. Those of an array stand column by column;
/// zeros among them are not kept.
template <std::floating_point S, std::signed_integral I>
[[nodiscard]] std::vector<Eigen::Triplet<S, I>> parse_entries(line_scanner& lines,
                                                              matrix_market_header const& header) {
  std::vector<Eigen::Triplet<S, I>> entries;
  if (!header.array) {
    entries.reserve(static_cast<std::size_t>(header.entries) * (header.symmetric ? 2 : 1));
  }
  index row = -1, col = 0;
  for (index k = 0; k < header.entries; ++k) {
    next_entry(lines, k, header);
    if (!header.array) {
      std::tie(row, col) = parse_position(lines, header);
    } else if (++row == header.rows) {
      ++col;
      row = header.symmetric ? col : 0;
    }
    S const value = header.pattern ? S(1) : parse_entry<S>(lines, header.integer);
    lines.expect_end_of_line(header.array ? "one number per line in an array"
                                          : "nothing after the entry");
    if (header.array && value == 0) continue;
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
  auto const entries = detail::parse_entries<S, I>(lines, header);
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

// --- write matrix market -------------------------------------------------------------------------
//
// Writes sparse matrices in Matrix Market format, so that reading gives the same bits.

/// What is stored: all entries, or the lower triangle of a symmetric matrix.
enum class matrix_market_symmetry : unsigned char { general, symmetric };

namespace detail {

inline std::string name_of_entry(index row, index col) {
  return " in row " + show(row + 1) + ", column " + show(col + 1);
}

/// Throws bad_input, naming the first entry that differs from its mirror image.
template <class Matrix>
void expect_symmetric(std::string const& file, Matrix const& A) {
  if (A.rows() != A.cols())
    throw bad_input(file, show(A.rows()) + " rows and " + show(A.cols()) + " columns",
                    "a square matrix, since it is to be stored as symmetric");
  Matrix const mirrored = A.transpose();
  Matrix const difference = A - mirrored;
  for (index col = 0; col < difference.outerSize(); ++col)
    for (typename Matrix::InnerIterator entry(difference, col); entry; ++entry)
      if (entry.value() != 0)
        throw bad_input(file,
                        show(A.coeff(entry.row(), entry.col())) +
                            name_of_entry(entry.row(), entry.col()) + " and " +
                            show(A.coeff(entry.col(), entry.row())) + " in its mirror image",
                        "equal entries, since it is to be stored as symmetric");
}

}  // namespace detail

/// Appends a matrix. Explicit zeros are written. Throws bad_input for NaN and infinity, and for a
/// matrix that is not exactly symmetric though it is to be stored so; std::system_error if there is
/// no room.
template <class Derived>
void write_matrix_market(atomic_file& file, Eigen::SparseMatrixBase<Derived> const& matrix,
                         matrix_market_symmetry symmetry = matrix_market_symmetry::general) {
  using matrix_type = Eigen::SparseMatrix<typename Derived::Scalar, Eigen::ColMajor,
                                          typename Derived::StorageIndex>;
  matrix_type const A(matrix.derived());
  std::string const name = detail::printable(file.target());
  bool const lower = symmetry == matrix_market_symmetry::symmetric;

  index count = 0;
  for (index col = 0; col < A.outerSize(); ++col)
    for (typename matrix_type::InnerIterator entry(A, col); entry; ++entry) {
      if (!std::isfinite(entry.value()))
        throw bad_input(
            name, detail::show(entry.value()) + detail::name_of_entry(entry.row(), entry.col()),
            "finite entries");
      if (!lower || entry.row() >= entry.col()) ++count;
    }
  if (lower) detail::expect_symmetric(name, A);

  std::string text = "%%MatrixMarket matrix coordinate real ";
  text.append(lower ? "symmetric\n" : "general\n");
  text.append(detail::show(A.rows()) + " " + detail::show(A.cols()) + " " + detail::show(count));
  text += '\n';
  for (index col = 0; col < A.outerSize(); ++col) {
    for (typename matrix_type::InnerIterator entry(A, col); entry; ++entry) {
      if (lower && entry.row() < entry.col()) continue;
      detail::append_number(text, entry.row() + 1);
      text += ' ';
      detail::append_number(text, entry.col() + 1);
      text += ' ';
      detail::append_number(text, entry.value());
      text += '\n';
    }
    file.write(text);
    text.clear();
  }
  file.write(text);
}

/// The same as a file of its own, which appears complete or not at all.
template <class Derived>
void write_matrix_market(std::filesystem::path const& path,
                         Eigen::SparseMatrixBase<Derived> const& matrix,
                         matrix_market_symmetry symmetry = matrix_market_symmetry::general) {
  atomic_file file(path);
  write_matrix_market(file, matrix, symmetry);
  file.commit();
}

}  // namespace slant
