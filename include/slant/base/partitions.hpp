// SPDX-License-Identifier: MIT
//
// Partitions of unknowns: by nodes, and by what is connected.
#pragma once

#include <slant/concepts/scalar.hpp>

#include <Eigen/SparseCore>

#include <cstddef>
#include <numeric>
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
  for (index const b : {3, 2}) {
    if (k.rows() == 0 || k.rows() % b != 0) continue;
    bool good = true;
    std::vector<index> reference, pattern;
    for (index j = 0; j < k.outerSize() && good; ++j) {
      pattern.clear();
      for (typename M::InnerIterator e(k.derived(), j); e; ++e) {
        pattern.push_back(M::IsRowMajor ? e.col() : e.row());
      }
      for (std::size_t i = 0; i < pattern.size() && good; ++i) {
        good = pattern.size() % static_cast<std::size_t>(b) == 0 &&
               pattern[i] % b == static_cast<index>(i) % b;
      }
      if (j % b == 0) std::swap(reference, pattern);
      good = good && (j % b == 0 || reference == pattern);
    }
    if (good) return b;
  }
  return 1;
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
