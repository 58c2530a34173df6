// SPDX-License-Identifier: MIT
//
// A box cut into equal cells and each cell into D! Kuhn simplices: 2 triangles or 6 tetrahedra
// around one diagonal. Every cell uses the same diagonal direction, (0,…,0) → (1,…,1), so
// neighbours fit. A Kuhn simplex is the path from one end of the diagonal to the other along the
// axes, one simplex for each order of the axes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <fem/require.hpp>
#include <fem/simplex_mesh.hpp>

namespace fem {

/// One side of a box: the points whose coordinate `axis` is at its lower or its upper end.
struct box_side {
  int axis;
  bool upper;
};

/// A simplex mesh of a box which remembers its lattice, so that membership in a side is exact.
/// Node (i₀, i₁, …) has the number ((i₀ n₁ + i₁) n₂ + i₂): the last axis runs fastest, which keeps
/// the bandwidth small when the box is longest in its first direction.
template <int D>
struct box_mesh : simplex_mesh<D> {
  std::array<int, D> cells_along{};
  Eigen::Matrix<double, D, 1> origin;
  Eigen::Matrix<double, D, 1> size;

  /// Lattice coordinates of a node, 0 … cells_along[axis].
  [[nodiscard]] std::array<int, D> lattice(Eigen::Index node) const {
    std::array<int, D> at{};
    for (auto axis = static_cast<std::size_t>(D); axis-- > 0;) {
      Eigen::Index const count = cells_along[axis] + 1;
      at[axis] = static_cast<int>(node % count);
      node /= count;
    }
    return at;
  }

  /// Does a node lie on a side?
  [[nodiscard]] bool on(box_side side, Eigen::Index node) const {
    auto const axis = static_cast<std::size_t>(side.axis);
    return lattice(node)[axis] == (side.upper ? cells_along[axis] : 0);
  }

  /// All nodes of a side, in increasing order.
  [[nodiscard]] std::vector<int> nodes_on(box_side side) const {
    std::vector<int> found;
    for (int node = 0; node < this->node_count(); ++node)
      if (on(side, node)) found.push_back(node);
    return found;
  }
};

/// Meshes the box [origin, origin + size] by cells_along[0] × cells_along[1] × … cells.
/// Throws std::invalid_argument for a cell count < 1, a mesh whose node numbers do not fit an int,
/// or a size that is not positive and finite.
template <int D>
[[nodiscard]] box_mesh<D> make_box_mesh(
    std::array<int, D> const& cells_along, Eigen::Matrix<double, D, 1> const& size,
    Eigen::Matrix<double, D, 1> const& origin = Eigen::Matrix<double, D, 1>::Zero()) {
  static_assert(D == 2 || D == 3);
  constexpr auto dimension = static_cast<std::size_t>(D);
  double node_count = 1;
  for (std::size_t axis = 0; axis < dimension; ++axis) {
    auto const a = static_cast<Eigen::Index>(axis);
    require(cells_along[axis] >= 1, "cells_along", cells_along[axis], "at least one cell");
    require(size[a] > 0 && std::isfinite(size[a]), "size", size[a], "a positive finite length");
    require(std::isfinite(origin[a]), "origin", origin[a], "a finite coordinate");
    node_count *= cells_along[axis] + 1.0;
  }
  // Tetrahedra and displacement components are the largest counts: six of either per node.
  require(6 * node_count < std::numeric_limits<int>::max(), "cells_along", node_count,
          "fewer nodes (their unknowns are numbered by int)");

  box_mesh<D> mesh;
  mesh.cells_along = cells_along;
  mesh.origin = origin;
  mesh.size = size;

  mesh.nodes.resize(D, static_cast<Eigen::Index>(node_count));
  for (Eigen::Index node = 0; node < mesh.node_count(); ++node) {
    auto const at = mesh.lattice(node);
    for (std::size_t axis = 0; axis < dimension; ++axis) {
      auto const a = static_cast<Eigen::Index>(axis);
      mesh.nodes(a, node) = origin[a] + size[a] * at[axis] / cells_along[axis];
    }
  }

  // Distance in node numbers of one step along each axis.
  std::array<int, dimension> stride{};
  stride[dimension - 1] = 1;
  for (std::size_t axis = dimension - 1; axis > 0; --axis)
    stride[axis - 1] = stride[axis] * (cells_along[axis] + 1);

  Eigen::Index cell_count = D == 2 ? 2 : 6;
  for (int count : cells_along) cell_count *= count;
  mesh.cells.resize(D + 1, cell_count);
  Eigen::Index cell = 0;
  for (int corner = 0; corner < mesh.node_count(); ++corner) {
    auto const at = mesh.lattice(corner);
    bool const begins_a_cell = std::equal(at.begin(), at.end(), cells_along.begin(), std::less<>{});
    if (!begins_a_cell) continue;
    std::array<std::size_t, dimension> order{};
    for (std::size_t axis = 0; axis < dimension; ++axis) order[axis] = axis;
    do {
      mesh.cells(0, cell) = corner;
      for (std::size_t step = 0; step < dimension; ++step)
        mesh.cells(static_cast<Eigen::Index>(step) + 1, cell) =
            mesh.cells(static_cast<Eigen::Index>(step), cell) + stride[order[step]];
      if (element_of(mesh, cell).volume < 0)  // an odd order of the axes
        std::swap(mesh.cells(D - 1, cell), mesh.cells(D, cell));
      ++cell;
    } while (std::next_permutation(order.begin(), order.end()));
  }
  return mesh;
}

}  // namespace fem
