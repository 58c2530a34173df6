// SPDX-License-Identifier: MIT
//
// The steel brick of two materials in cubes of k/4 cells.
#pragma once

#include <fem/steel_brick.hpp>

#include <cmath>
#include <vector>

namespace test {

/// The stiffness of the brick of 3k × k × k cells, k a multiple of 4, in which every other cube is
/// of a material that is stiffer by this factor.
inline Eigen::SparseMatrix<double> chequered_stiffness(int k, double factor) {
  auto const mesh = fem::make_brick_mesh(k, {3, 1, 1});
  auto const unknowns =
      fem::number_unknowns(mesh, [&](Eigen::Index i) { return mesh.on(fem::brick_side::left, i); });
  std::vector<Eigen::Index> cells[2];
  for (Eigen::Index c = 0; c < mesh.cell_count(); ++c) {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (Eigen::Index a = 0; a < 4; ++a) centre += mesh.nodes.col(mesh.cells(a, c)) / 4;
    int sum = 0;
    for (Eigen::Index a = 0; a < 3; ++a) sum += static_cast<int>(std::floor(4 * centre[a]));
    cells[sum % 2].push_back(c);
  }
  Eigen::SparseMatrix<double> K(unknowns.count, unknowns.count);
  for (int part = 0; part < 2; ++part) {
    fem::simplex_mesh<3> const own{mesh.nodes, mesh.cells(Eigen::all, cells[part])};
    K += fem::stiffness<3>(own, unknowns, fem::lame(2.119e5 * (part == 0 ? 1 : factor), 0.277));
  }
  return K;
}

}  // namespace test
