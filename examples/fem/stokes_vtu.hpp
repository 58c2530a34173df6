// SPDX-License-Identifier: MIT
//
// A Stokes flow for ParaView: velocity and pressure, and what happens along the wall.
#pragma once

#include <filesystem>
#include <slant/io/vtu.hpp>

#include <fem/stokes_field.hpp>

namespace fem {

/// wall_state of the points in the file that are no wall nodes; the others have stick = 0, slip
/// = 1.
inline constexpr int no_wall_node = -1;

/// Writes the mesh with the point data velocity, pressure, shear_stress (σ_t, 0 off the wall) and
/// wall_state. Throws slant::bad_input for numbers that are not finite or a file that cannot be
/// written, std::system_error if there is no room.
inline void write_stokes_vtu(std::filesystem::path const& file, stokes_scene const& scene,
                             stokes_solution const& solution, wall_field const& field,
                             slant::vtu_encoding encoding = slant::vtu_encoding::base64) {
  Eigen::Index const points = scene.mesh.node_count();
  Eigen::VectorXd shear = Eigen::VectorXd::Zero(points);
  Eigen::VectorXi state = Eigen::VectorXi::Constant(points, no_wall_node);
  for (Eigen::Index i = 0; i < field.size(); ++i) {
    auto const at = static_cast<std::size_t>(i);
    shear[scene.wall[at].node] = field.shear[i];
    state[scene.wall[at].node] = static_cast<int>(field.state[at]);
  }
  slant::vtu_grid grid(scene.mesh.nodes, encoding);
  grid.add_cells(slant::vtu_cell::triangle, scene.mesh.cells);
  grid.add_point_vectors("velocity", scene.velocity(solution.u));
  grid.add_point_scalars("pressure", solution.p);
  grid.add_point_scalars("shear_stress", shear);
  grid.add_point_scalars("wall_state", state);
  grid.write(file);
}

}  // namespace fem
