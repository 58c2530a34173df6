// SPDX-License-Identifier: MIT
//
// Which displacement components are unknown. Fixed nodes have none; the others have D consecutive
// ones, numbered in the order of the nodes.
#pragma once

#include <Eigen/Core>

#include <fem/simplex_mesh.hpp>

namespace fem {

/// Number of the first of the D unknowns of each node, or -1 where the node is fixed.
struct unknown_map {
  Eigen::VectorXi first;
  Eigen::Index count = 0;

  [[nodiscard]] bool is_fixed(Eigen::Index node) const { return first[node] < 0; }
};

/// Numbers the unknowns of all nodes for which `fixed(node)` is false.
template <int D, class Predicate>
[[nodiscard]] unknown_map number_unknowns(simplex_mesh<D> const& mesh, Predicate const& fixed) {
  unknown_map unknowns;
  unknowns.first.resize(mesh.node_count());
  for (Eigen::Index node = 0; node < mesh.node_count(); ++node) {
    if (fixed(node)) {
      unknowns.first[node] = -1;
    } else {
      unknowns.first[node] = static_cast<int>(unknowns.count);
      unknowns.count += D;
    }
  }
  return unknowns;
}

/// Displacement of every node (one column each) from the vector of unknowns; zero where fixed.
template <int D>
[[nodiscard]] Eigen::Matrix<double, D, Eigen::Dynamic> nodal_displacement(
    unknown_map const& unknowns, Eigen::VectorXd const& u) {
  Eigen::Matrix<double, D, Eigen::Dynamic> result(D, unknowns.first.size());
  for (Eigen::Index node = 0; node < result.cols(); ++node) {
    if (unknowns.is_fixed(node))
      result.col(node).setZero();
    else
      result.col(node) = u.template segment<D>(unknowns.first[node]);
  }
  return result;
}

}  // namespace fem
