// SPDX-License-Identifier: MIT
//
// The graph of a stiffness matrix: unknowns i, j are neighbours if K_ij is stored. Its connected
// components are the bodies.
#pragma once

#include <slant/operators/detail/union_find.hpp>

#include <Eigen/SparseCore>

#include <cstddef>
#include <vector>

namespace slant::contact::detail {

/// Unknowns of each body, in increasing order; bodies in the order of their first unknown.
template <class S>
[[nodiscard]] std::vector<std::vector<index>> bodies_of(Eigen::SparseMatrix<S> const& k) {
  slant::detail::union_find sets(k.rows());
  for (index j = 0; j < k.outerSize(); ++j) {
    for (typename Eigen::SparseMatrix<S>::InnerIterator e(k, j); e; ++e) sets.join(e.row(), j);
  }
  std::vector<index> number(static_cast<std::size_t>(k.rows()), -1);
  std::vector<std::vector<index>> bodies;
  for (index j = 0; j < k.rows(); ++j) {
    index& body = number[static_cast<std::size_t>(sets.find(j))];
    if (body < 0) {
      body = static_cast<index>(bodies.size());
      bodies.emplace_back();
    }
    bodies[static_cast<std::size_t>(body)].push_back(j);
  }
  return bodies;
}

}  // namespace slant::contact::detail
