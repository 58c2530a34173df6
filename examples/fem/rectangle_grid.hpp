// SPDX-License-Identifier: MIT
//
// A rectangle (0, width) × (0, height) with nx × ny interior nodes in equal distances; on the edges
// of the rectangle everything is zero and no unknown.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include <fem/require.hpp>

namespace fem {

/// Grid of a rectangle. Nodes i = −1 and nx, j = −1 and ny lie on the edges.
template <class S = double>
struct rectangle_grid {
  Eigen::Index nx = 1;  ///< interior nodes in x
  Eigen::Index ny = 1;  ///< and in y
  S width{1};
  S height{1};

  /// Distance of neighbours in x and in y.
  [[nodiscard]] S hx() const { return width / number(nx + 1); }
  [[nodiscard]] S hy() const { return height / number(ny + 1); }
  /// Position of node (i, j).
  [[nodiscard]] S x(Eigen::Index i) const { return number(i + 1) * hx(); }
  [[nodiscard]] S y(Eigen::Index j) const { return number(j + 1) * hy(); }
  /// Number of unknowns, one for each interior node.
  [[nodiscard]] Eigen::Index size() const { return nx * ny; }
  /// The unknown of interior node (i, j): i runs fastest.
  [[nodiscard]] Eigen::Index unknown(Eigen::Index i, Eigen::Index j) const { return i + nx * j; }
  /// Positions of all nodes in x, with the two on the edges; and in y.
  [[nodiscard]] std::vector<S> all_x() const {
    std::vector<S> positions;
    for (Eigen::Index i = -1; i <= nx; ++i) positions.push_back(x(i));
    return positions;
  }
  [[nodiscard]] std::vector<S> all_y() const {
    std::vector<S> positions;
    for (Eigen::Index j = -1; j <= ny; ++j) positions.push_back(y(j));
    return positions;
  }

 private:
  static S number(Eigen::Index n) { return S(static_cast<int>(n)); }
};

/// f(x, y) at all interior nodes, in the order of the unknowns.
template <class S, class Function>
[[nodiscard]] Eigen::Matrix<S, Eigen::Dynamic, 1> at_nodes(rectangle_grid<S> const& grid,
                                                           Function const& f) {
  Eigen::Matrix<S, Eigen::Dynamic, 1> values(grid.size());
  for (Eigen::Index j = 0; j < grid.ny; ++j)
    for (Eigen::Index i = 0; i < grid.nx; ++i) values[grid.unknown(i, j)] = f(grid.x(i), grid.y(j));
  return values;
}

/// Throws std::invalid_argument unless there are interior nodes, no more than 2¹⁵ in a direction,
/// in a rectangle of positive finite size.
template <class S>
void require_grid(rectangle_grid<S> const& grid) {
  using std::isfinite;
  require(grid.nx >= 1 && grid.nx <= (1 << 15), "nx", grid.nx, "between 1 and 2^15 nodes");
  require(grid.ny >= 1 && grid.ny <= (1 << 15), "ny", grid.ny, "between 1 and 2^15 nodes");
  require(grid.width > S(0) && isfinite(grid.width), "width", grid.width, "a positive number");
  require(grid.height > S(0) && isfinite(grid.height), "height", grid.height, "a positive number");
}

}  // namespace fem
