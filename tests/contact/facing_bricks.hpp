// SPDX-License-Identifier: MIT
//
// Two bricks, one on the other, whose meshes do not match: contacts are the nodes of the upper one,
// each between the four nodes of the lower one around it, which several contacts share.
#pragma once

#include <fem/two_bodies.hpp>

#include <Eigen/SparseCore>

#include <cmath>
#include <vector>

namespace test {

/// p and q nodes along an edge.
inline fem::contact_scene<3> facing_bricks(int p, int q) {
  auto const brick = [](int nodes, double height, double ν) {
    return fem::loaded_box<3>{.mesh = fem::make_box_mesh<3>({nodes, nodes - 1, nodes - 1},
                                                            {2000, 1000, 1000}, {0, 0, height}),
                              .material = fem::lame(5e4, ν),
                              .fixed = {0, false}};
  };
  fem::boxes_in_contact<3> pair{
      .first = brick(p, 1000, 0.277), .second = brick(q, 0, 0.35), .contact = {2, false}};
  pair.first.loads.push_back({{2, true}, {0, 0, -1}});
  pair.second.loads.push_back({{0, true}, {0, 0, -1}});
  fem::contact_scene<3> s;
  fem::detail::assemble_bodies(pair, s);
  int const behind = static_cast<int>(pair.first.mesh.node_count());
  std::vector<Eigen::Triplet<double>> N, T;
  int m = 0;
  auto const put = [&](int node, double weight) {
    if (weight == 0 || s.unknowns.is_fixed(node)) return;
    int const first = s.unknowns.first[node];
    N.emplace_back(m, first + 2, -weight);
    for (int a = 0; a < 2; ++a) T.emplace_back(2 * m + a, first + a, weight);
  };
  for (int const node : pair.first.mesh.nodes_on({2, false})) {
    if (s.unknowns.is_fixed(node)) continue;
    put(node, 1);
    for (int const below : pair.second.mesh.nodes_on({2, true})) {
      Eigen::Vector3d const away = s.mesh.nodes.col(node) - s.mesh.nodes.col(behind + below);
      double const x = 1 - std::abs(away[0]) * q / 2000, y = 1 - std::abs(away[1]) * (q - 1) / 1000;
      put(behind + below, x > 1e-12 && y > 1e-12 ? -x * y : 0);
    }
    ++m;
  }
  s.N.resize(m, s.K.rows());
  s.T.resize(2 * m, s.K.rows());
  s.N.setFromTriplets(N.begin(), N.end());
  s.T.setFromTriplets(T.begin(), T.end());
  s.d = Eigen::VectorXd::Zero(m);
  s.g = Eigen::VectorXd::Constant(m, 0.3 * 2e6 / (p * (p - 1.0)));
  return s;
}

}  // namespace test
