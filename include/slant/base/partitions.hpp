// SPDX-License-Identifier: MIT
//
// Partitions of unknowns: by nodes, and by what is connected.
#pragma once

#include <slant/concepts/scalar.hpp>

#include <Eigen/SparseCore>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <type_traits>
#include <utility>
#include <vector>

namespace slant {

// --- node blocks ---------------------------------------------------------------------------------
//
// Unknowns of one node of a mesh: blocks of consecutive rows of a matrix, told by its pattern.

/// Node i has the unknowns first[i] … first[i + 1] − 1; the last entry is their number.
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
  /// The node of each unknown.
  [[nodiscard]] std::vector<int> owners() const {
    std::vector<int> node(static_cast<std::size_t>(first.back()));
    for (index i = 0; i < count(); ++i) {
      for (int j = begin(i); j < end(i); ++j)
        node[static_cast<std::size_t>(j)] = static_cast<int>(i);
    }
    return node;
  }
};

/// The largest b of 3, 2, 1 such that K consists of b × b blocks without a gap; 1 if there is
/// doubt.
template <class M>
[[nodiscard]] index detected_block_size(Eigen::SparseCompressedBase<M> const& k) {
  auto const* const inner = k.innerIndexPtr();
  auto const* const first = k.outerIndexPtr();
  auto const end = [&](index j) {
    return k.isCompressed() ? first[j + 1] : first[j] + k.innerNonZeroPtr()[j];
  };
  // Column j: b consecutive rows after each multiple of b, and those of the columns of its node.
  auto const fits = [&]<int b>(index j, std::integral_constant<int, b>) {
    index const count = end(j) - first[j], node = j - j % b;
    if (j > node) {
      return count == end(node) - first[node] &&
             std::equal(inner + first[j], inner + first[j] + count, inner + first[node]);
    }
    bool good = count % b == 0;
    for (auto const* i = inner + first[j]; good && i != inner + first[j] + count; i += b) {
      good = i[0] % b == 0;
      for (index q = 1; q < b; ++q) good = good && i[q] == i[0] + q;
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

// --- union find ----------------------------------------------------------------------------------
//
// Sets that grow together [Tarjan 1975]: which unknowns belong to the same body.

/// A partition of 0, …, n − 1, at first into single numbers.
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

 private:
  index& parent(index i) { return parent_[static_cast<std::size_t>(i)]; }

  std::vector<index> parent_;
};

}  // namespace slant::detail
