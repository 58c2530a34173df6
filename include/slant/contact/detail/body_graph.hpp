// SPDX-License-Identifier: MIT
//
// The graph of a stiffness matrix: unknowns i, j are neighbours if K_ij is stored. Its connected
// components are the bodies.
#pragma once

#include <slant/operators/detail/union_find.hpp>

#include <Eigen/SparseCore>

#include <algorithm>
#include <cstddef>
#include <limits>
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

/// The unknowns with the same neighbours as unknown j: those of the same node. j is one of them.
template <class S>
[[nodiscard]] std::vector<index> node_of(Eigen::SparseMatrix<S> const& k, index j) {
  int const* const begin = k.outerIndexPtr();
  int const* const row = k.innerIndexPtr();
  std::vector<index> node;
  for (int p = begin[j]; p < begin[j + 1]; ++p) {
    int const i = row[p];
    if (std::equal(row + begin[i], row + begin[i + 1], row + begin[j], row + begin[j + 1])) {
      node.push_back(i);
    }
  }
  if (node.empty()) node.push_back(j);
  return node;
}

/// The unknown of a body that is the most edges away from the sources; its first one if there are
/// none.
template <class S>
[[nodiscard]] index farthest_unknown(Eigen::SparseMatrix<S> const& k,
                                     std::vector<index> const& body,
                                     std::vector<index> const& sources) {
  if (sources.empty()) return body.front();
  std::vector<unsigned char> seen(static_cast<std::size_t>(k.rows()), 0);
  std::vector<index> queue = sources;
  for (index const i : queue) seen[static_cast<std::size_t>(i)] = 1;
  for (std::size_t next = 0; next < queue.size(); ++next) {
    for (typename Eigen::SparseMatrix<S>::InnerIterator e(k, queue[next]); e; ++e) {
      auto& mark = seen[static_cast<std::size_t>(e.row())];
      if (mark != 0) continue;
      mark = 1;
      queue.push_back(e.row());
    }
  }
  return queue.back();
}

}  // namespace slant::contact::detail
