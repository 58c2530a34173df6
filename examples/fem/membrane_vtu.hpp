// SPDX-License-Identifier: MIT
//
// The solution of an obstacle problem for ParaView.
#pragma once

#include <filesystem>
#include <slant/io/vtu.hpp>

#include <fem/membrane_contact.hpp>

namespace fem {

/// Writes the triangles of the grid, the edges of the rectangle included, with the point data
/// height (v), contact (−1 on the lower bound, 1 on the upper one, else 0) and reaction (force per
/// area). Throws slant::bad_input for numbers that are not finite or a file that cannot be written,
/// std::system_error if there is no room.
inline void write_membrane_vtu(std::filesystem::path const& file, membrane<> const& m,
                               Eigen::VectorXd const& v, membrane_contact<> const& contact,
                               slant::vtu_encoding encoding = slant::vtu_encoding::base64) {
  auto const& grid = m.grid;
  Eigen::Index const columns = grid.nx + 2;
  Eigen::Index const points = columns * (grid.ny + 2);
  Eigen::Matrix2Xd places(2, points);
  Eigen::VectorXd height = Eigen::VectorXd::Zero(points);
  Eigen::VectorXd reaction = Eigen::VectorXd::Zero(points);
  Eigen::VectorXi state = Eigen::VectorXi::Zero(points);
  auto const point = [&](Eigen::Index i, Eigen::Index j) { return i + 1 + columns * (j + 1); };
  for (Eigen::Index j = -1; j <= grid.ny; ++j)
    for (Eigen::Index i = -1; i <= grid.nx; ++i) {
      places.col(point(i, j)) << grid.x(i), grid.y(j);
      if (i < 0 || j < 0 || i == grid.nx || j == grid.ny) continue;
      Eigen::Index const unknown = grid.unknown(i, j);
      height[point(i, j)] = v[unknown];
      reaction[point(i, j)] = contact.reaction[unknown];
      state[point(i, j)] = contact.state[unknown];
    }
  Eigen::Matrix3Xi triangles(3, 2 * (grid.nx + 1) * (grid.ny + 1));
  Eigen::Index triangle = 0;
  for (Eigen::Index j = 0; j <= grid.ny; ++j)
    for (Eigen::Index i = 0; i <= grid.nx; ++i) {
      auto const corner = [&](int right, int up) {
        return static_cast<int>(point(i - 1 + right, j - 1 + up));
      };
      triangles.col(triangle++) << corner(0, 0), corner(1, 0), corner(0, 1);
      triangles.col(triangle++) << corner(1, 1), corner(0, 1), corner(1, 0);
    }
  slant::vtu_grid output(places, encoding);
  output.add_cells(slant::vtu_cell::triangle, triangles);
  output.add_point_scalars("height", height);
  output.add_point_scalars("contact", state);
  output.add_point_scalars("reaction", reaction);
  output.write(file);
}

}  // namespace fem
