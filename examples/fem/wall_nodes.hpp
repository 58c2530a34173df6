// SPDX-License-Identifier: MIT
//
// The nodes of a wall, straight or curved: normals, tangents and the weights of the trapezoidal
// rule, from nothing but the edges.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <map>
#include <vector>

#include <fem/planar_domain.hpp>

namespace fem {

/// One node of a wall. (n, t) is orthonormal and right-handed: t is n turned by +90°, so that who
/// walks along t has the domain on the left; around an obstacle t runs clockwise.
struct wall_node {
  int node;
  Eigen::Vector2d normal;   ///< n, out of the domain
  Eigen::Vector2d tangent;  ///< t
  double weight;            ///< ω, half of the lengths of the adjoining edges
};

/// The nodes of a part of the boundary for which keep(node), in the order of their numbers. The
/// normal of a node is that of the sum of its edges' normals, weighted by their lengths: ∫ φ_i n
/// of the hat function φ_i. With these, u_n = 0 at all nodes means that nothing flows through the
/// polygon [Engelman, Sani, Gresho 1982]; evenly spaced on a circle, they are its normals.
/// Throws std::invalid_argument where a wall turns back on itself.
template <class Keep>
[[nodiscard]] std::vector<wall_node> wall_nodes(planar_domain const& domain, int part,
                                                Keep const& keep) {
  std::map<int, wall_node> nodes;
  for (auto const& edge : domain.boundary) {
    if (edge.part != part) continue;
    Eigen::Vector2d const n = domain.outward(edge);
    for (int const node : {edge.from, edge.to}) {
      if (!keep(node)) continue;
      auto& at = nodes.try_emplace(node, wall_node{node, {0, 0}, {0, 0}, 0}).first->second;
      at.normal += n / 2;
      at.weight += n.norm() / 2;
    }
  }
  std::vector<wall_node> result;
  for (auto& [node, at] : nodes) {
    double const size = at.normal.norm();
    // The angle between the two edges is then far from 0.
    require(size > 1e-3 * at.weight, "wall node", node, "edges that do not turn back");
    at.normal /= size;
    at.tangent = {-at.normal[1], at.normal[0]};
    result.push_back(at);
  }
  return result;
}

}  // namespace fem
