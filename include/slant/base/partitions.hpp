// SPDX-License-Identifier: MIT
//
// Partitions of unknowns: by nodes, and by what is connected.
#pragma once

#include <slant/concepts/scalar.hpp>

#include <Eigen/SparseCore>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace slant {

/// Unknowns of the nodes of a mesh, consecutive rows of a matrix. Node i has the unknowns
/// first[i] … first[i + 1] − 1; the last entry is their number.
struct node_blocks {
  std::vector<int> first{0};

  node_blocks() = default;
  /// Nodes of equal size; n is a multiple of it.
  node_blocks(index n, index size) : first(static_cast<std::size_t>(n / size + 1)) {
    for (std::size_t i = 0; i < first.size(); ++i) {
      first[i] = static_cast<int>(static_cast<index>(i) * size);
    }
  }

  [[nodiscard]] index count() const { return static_cast<index>(first.size()) - 1; }
  [[nodiscard]] int begin(index i) const { return first[static_cast<std::size_t>(i)]; }
  [[nodiscard]] int end(index i) const { return first[static_cast<std::size_t>(i) + 1]; }
};

namespace detail {

/// The numbers 0 … n − 1 that are not among these, which increase.
[[nodiscard]] inline std::vector<index> complement(index n, std::vector<index> const& numbers) {
  std::vector<index> rest;
  for (index i = 0; i < n; ++i) {
    if (!std::binary_search(numbers.begin(), numbers.end(), i)) rest.push_back(i);
  }
  return rest;
}

/// The rows of the entries of column j; of a matrix that is stored by rows the columns of row j.
template <class M>
[[nodiscard]] auto inner_indices(Eigen::SparseCompressedBase<M> const& k, index j) {
  auto const* const first = k.innerIndexPtr() + k.outerIndexPtr()[j];
  auto const count =
      k.isCompressed() ? k.outerIndexPtr()[j + 1] - k.outerIndexPtr()[j] : k.innerNonZeroPtr()[j];
  return std::span(first, static_cast<std::size_t>(count));
}

}  // namespace detail

/// The largest b of 3, 2, 1 such that K consists of b × b blocks without a gap; 1 if there is
/// doubt.
template <class M>
[[nodiscard]] index detected_block_size(Eigen::SparseCompressedBase<M> const& k) {
  // Column j: b consecutive rows after each multiple of b, and those of the columns of its node.
  auto const fits = [&]<int b>(index j, std::integral_constant<int, b>) {
    auto const rows = detail::inner_indices(k, j);
    if (auto const first = detail::inner_indices(k, j - j % b); j % b > 0) {
      return std::equal(rows.begin(), rows.end(), first.begin(), first.end());
    }
    bool good = rows.size() % b == 0;
    for (std::size_t e = 0; good && e < rows.size(); ++e) {
      good = rows[e] % b == index(e % b) && rows[e] == rows[e - e % b] + index(e % b);
    }
    return good;
  };
  auto const all = [&](auto b) {
    bool good = k.rows() > 0 && k.rows() % b == 0 && k.outerSize() % b == 0;
    for (index j = 0; j < k.outerSize() && good; ++j) good = fits(j, b);
    return good;
  };
  if (all(std::integral_constant<int, 3>{})) return 3;
  return all(std::integral_constant<int, 2>{}) ? 2 : 1;
}

}  // namespace slant

namespace slant::detail {

/// A partition of 0, …, n − 1, at first into single numbers [Tarjan 1975].
class union_find {
 public:
  explicit union_find(index n) : parent_(static_cast<std::size_t>(n)) {
    std::iota(parent_.begin(), parent_.end(), index(0));
  }

  /// The smallest number of the set of i.
  [[nodiscard]] index find(index i) {
    while (parent(i) != i) {
      parent(i) = parent(parent(i));
      i = parent(i);
    }
    return i;
  }
  /// From now on one set.
  void join(index i, index j) {
    i = find(i);
    j = find(j);
    if (i > j) std::swap(i, j);
    parent(j) = i;
  }
  /// The sets: their numbers in increasing order, sets in the order of their first ones.
  [[nodiscard]] std::vector<std::vector<index>> lists() {
    std::vector<std::vector<index>> all;
    std::vector<std::size_t> place(parent_.size());
    for (index i = 0; i < static_cast<index>(parent_.size()); ++i) {
      index const first = find(i);
      if (first == i) {
        place[static_cast<std::size_t>(i)] = all.size();
        all.emplace_back();
      }
      all[place[static_cast<std::size_t>(first)]].push_back(i);
    }
    return all;
  }

 private:
  index& parent(index i) { return parent_[static_cast<std::size_t>(i)]; }

  std::vector<index> parent_;
};

}  // namespace slant::detail
