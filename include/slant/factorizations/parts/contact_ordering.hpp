// SPDX-License-Identifier: MIT
//
// Fill-reducing orderings that keep a few chosen unknowns, those in contact, near the end of the
// elimination, so that what they need of K⁻¹ is a small dense part of the factors.
//
// Given is any good ordering (METIS) with its elimination tree. Its separators are the chains at
// the top: stripping the `levels` topmost ones leaves subtrees, the subdomains. In each of them the
// chosen unknowns move behind the others of the same subdomain:
//
//     levels 0      all of them last: one dense block, most fill
//     levels 1, 2…  behind their half, quarter, … of the body; less fill, but the separators
//                   above have to be swept as well
//
// Moving unknowns back within a subtree leaves everything outside of it as it is.
#pragma once

#include <slant/base/matrix_entries.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/scalar.hpp>

#include <Eigen/SparseCore>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace slant::detail {

/// The subtrees of an elimination forest (parent[j] > j, or −1; postordered, so that each subtree
/// is a range of columns) below its topmost separators.
class separator_tree {
  static auto& at(auto& v, int i) { return v[static_cast<std::size_t>(i)]; }

 public:
  explicit separator_tree(std::vector<int> const& parent)
      : first_(parent.size()), children_(parent.size() + 1) {
    int const n = static_cast<int>(parent.size());
    for (int j = 0; j < n; ++j) at(first_, j) = j;
    for (int j = 0; j < n; ++j) {
      int const p = at(parent, j);
      if (p >= 0) at(first_, p) = std::min(at(first_, p), at(first_, j));
      (p >= 0 ? at(children_, p) : children_.back()).push_back(j);
    }
  }

  /// Columns [first, last] of each subtree under the topmost `levels` separators, in order.
  [[nodiscard]] std::vector<std::pair<int, int>> subtrees(index levels) const {
    std::vector<int> roots = children_.back();
    for (index l = 0; l < levels && !roots.empty(); ++l) {
      std::vector<int> below;
      for (int root : roots) {
        auto const& parts = children_of_chain(root);
        below.insert(below.end(), parts.begin(), parts.end());
      }
      roots = std::move(below);
    }
    std::vector<std::pair<int, int>> ranges;
    for (int root : roots) ranges.emplace_back(at(first_, root), root);
    std::sort(ranges.begin(), ranges.end());
    return ranges;
  }

 private:
  [[nodiscard]] int size_of(int root) const { return root - at(first_, root) + 1; }

  /// Down from a root to where the tree really branches. A separator is a chain, but for a few
  /// columns that hang on it without being a part of the body of their own.
  [[nodiscard]] std::vector<int> const& children_of_chain(int root) const {
    int node = root;
    while (true) {
      auto const& below = at(children_, node);
      auto const largest = std::max_element(
          below.begin(), below.end(), [this](int a, int b) { return size_of(a) < size_of(b); });
      if (largest == below.end() || 10 * size_of(*largest) < 9 * (size_of(node) - 1)) return below;
      node = *largest;
    }
  }

  std::vector<int> first_;                  ///< first column of the subtree of a column
  std::vector<std::vector<int>> children_;  ///< of each column; the last entry holds the roots
};

/// The ordering (position → unknown) with the marked unknowns behind the others of their subtree.
[[nodiscard]] inline std::vector<int> postponed(std::vector<int> const& order,
                                                std::vector<char> const& marked,
                                                std::vector<std::pair<int, int>> const& subtrees) {
  std::vector<int> result = order;
  for (auto const& [first, last] : subtrees) {
    std::stable_partition(result.begin() + first, result.begin() + last + 1, [&](int unknown) {
      return marked[static_cast<std::size_t>(unknown)] == 0;
    });
  }
  return result;
}

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
