// SPDX-License-Identifier: MIT
//
// Checks of arguments that the factories of operators share. All run once, at construction.
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/scalar.hpp>

#include <string>
#include <string_view>

namespace slant::detail {

[[nodiscard, gnu::cold]] inline std::string size_text(index rows, index cols) {
  return std::to_string(rows) + " x " + std::to_string(cols);
}

/// Throws unless the operator called `name` is rows × cols; `why` says where that size comes from.
void require_size(std::string_view name, auto const& a, index rows, index cols,
                  std::string_view why) {
  if (a.rows() != rows || a.cols() != cols) {
    throw bad_input(name, size_text(a.rows(), a.cols()),
                    size_text(rows, cols).append(" (").append(why).append(")"));
  }
}

/// Throws unless the operator called `name` has that many rows.
void require_rows(std::string_view name, auto const& a, index rows, std::string_view why) {
  if (a.rows() != rows) {
    throw bad_input(name, size_text(a.rows(), a.cols()),
                    std::to_string(rows).append(" rows (").append(why).append(")"));
  }
}

/// Throws unless the operator called `name` has that many columns.
void require_cols(std::string_view name, auto const& a, index cols, std::string_view why) {
  if (a.cols() != cols) {
    throw bad_input(name, size_text(a.rows(), a.cols()),
                    std::to_string(cols).append(" columns (").append(why).append(")"));
  }
}

/// Throws unless the rows can be independent.
void require_wide(std::string_view name, auto const& a) {
  if (a.rows() > a.cols()) {
    throw bad_input(name, size_text(a.rows(), a.cols()),
                    "at most as many rows as columns (independent rows)");
  }
}

void require_square(std::string_view name, auto const& a) {
  if (a.rows() != a.cols()) {
    throw bad_input(name, size_text(a.rows(), a.cols()), "a square operator");
  }
}

}  // namespace slant::detail
