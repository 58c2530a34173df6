// SPDX-License-Identifier: MIT
//
// Sets that grow together [Tarjan 1975]: which unknowns belong to the same body.
#pragma once

#include <slant/concepts/scalar.hpp>

#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace slant::detail {

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
