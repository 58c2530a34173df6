// SPDX-License-Identifier: MIT
//
// Matrices for the tests of multigrid.
#pragma once

#include <Eigen/SparseCore>

#include <fem/contact_scene.hpp>

#include <vector>

namespace test {

/// Five-point Laplacian of a grid of m × n points, fixed outside; its couplings across are weaker
/// by a factor. Points are numbered along the first direction.
template <class S = double>
Eigen::SparseMatrix<S> laplacian(int m, int n, double across = 1) {
  std::vector<Eigen::Triplet<S>> entries;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < m; ++i) {
      int const here = m * j + i;
      entries.emplace_back(here, here, S(2 + 2 * across));
      if (i > 0) entries.emplace_back(here, here - 1, S(-1));
      if (i + 1 < m) entries.emplace_back(here, here + 1, S(-1));
      if (j > 0) entries.emplace_back(here, here - m, S(-across));
      if (j + 1 < n) entries.emplace_back(here, here + m, S(-across));
    }
  }
  Eigen::SparseMatrix<S> K(m * n, m * n);
  K.setFromTriplets(entries.begin(), entries.end());
  return K;
}

/// Coordinates of the nodes of a scene that can move, in the order of their unknowns.
template <int D>
Eigen::MatrixXd moving_nodes(fem::contact_scene<D> const& s) {
  Eigen::MatrixXd nodes(D, s.f.size() / D);
  Eigen::Index next = 0;
  for (Eigen::Index i = 0; i < s.mesh.node_count(); ++i)
    if (!s.unknowns.is_fixed(i)) nodes.col(next++) = s.mesh.nodes.col(i);
  return nodes;
}

}  // namespace test
