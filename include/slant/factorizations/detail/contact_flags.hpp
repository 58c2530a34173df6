// SPDX-License-Identifier: MIT
//
// Lists of unknowns as marks, and matrices that must keep to them.
#pragma once

#include <slant/concepts/checks.hpp>
#include <slant/operators/detail/matrix_entries.hpp>

#include <Eigen/SparseCore>

#include <cstddef>
#include <vector>

namespace slant::detail {

/// A mark for each of n unknowns. Throws bad_input if one is out of range or named twice.
[[nodiscard]] inline std::vector<char> contact_flags(std::vector<index> const& contact, index n) {
  std::vector<char> marked(static_cast<std::size_t>(n), 0);
  for (std::size_t i = 0; i < contact.size(); ++i) {
    auto const complain = [&](char const* expected) {
      throw bad_input("contact", show(contact[i]), expected).at(static_cast<index>(i));
    };
    if (contact[i] < 0 || contact[i] >= n) complain("an unknown: a row of K");
    char& mark = marked[static_cast<std::size_t>(contact[i])];
    if (mark != 0) complain("each unknown once");
    mark = 1;
  }
  return marked;
}

/// Throws bad_input if B has not as many columns as there are marks, an entry that is not finite,
/// or a nonzero in a column that is not marked.
template <class B>
void require_touches_only(std::vector<char> const& marked, B const& b) {
  require_cols("B", b, static_cast<index>(marked.size()), "the size of K");
  Eigen::SparseMatrix<typename B::Scalar> const columns = b;
  require_finite_entries("B", columns);
  for (index j = 0; j < columns.cols(); ++j) {
    if (marked[static_cast<std::size_t>(j)] != 0) continue;
    for (typename decltype(columns)::InnerIterator e(columns, j); e; ++e) {
      if (e.value() == 0) continue;
      throw bad_input("B", "an entry in row " + show(index(e.row())) + ", column " + show(j),
                      "rows that touch contact unknowns only");
    }
  }
}

}  // namespace slant::detail
