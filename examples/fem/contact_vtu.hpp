// SPDX-License-Identifier: MIT
//
// A contact solution for ParaView: the displaced body with what happens on its contact side.
#pragma once

#include <filesystem>
#include <slant/io/vtu.hpp>

#include <fem/contact_field.hpp>

namespace fem {

/// contact_state of the points in the file that are no contact nodes; the others have open = 0,
/// stick = 1, slip = 2.
inline constexpr int no_contact_node = -1;

/// Writes the mesh with the point data displacement, contact_pressure, friction (force per area, 0
/// off the contact nodes) and contact_state; of two bodies on both contact sides. Throws
/// slant::bad_input for numbers that are not finite or a file that cannot be written,
/// std::system_error if there is no room.
template <int D>
void write_contact_vtu(std::filesystem::path const& file, contact_scene<D> const& scene,
                       contact_field<D> const& field, Eigen::VectorXd const& u,
                       slant::vtu_encoding encoding = slant::vtu_encoding::base64) {
  Eigen::Index const points = scene.mesh.node_count();
  Eigen::VectorXd pressure = Eigen::VectorXd::Zero(points);
  using vectors = Eigen::Matrix<double, D, Eigen::Dynamic>;
  vectors friction = vectors::Zero(D, points);
  Eigen::VectorXi state = Eigen::VectorXi::Constant(points, no_contact_node);
  for (Eigen::Index i = 0; i < field.size(); ++i) {
    auto const at = static_cast<std::size_t>(i);
    Eigen::Index const node = scene.contact_nodes[at];
    pressure[node] = field.normal[i];
    // The contact side is z = constant, of bodies in the plane y = constant.
    friction.col(node).template head<D - 1>() = field.friction.col(i);
    state[node] = static_cast<int>(field.state[at]);
    if (scene.opposite_nodes.empty()) continue;
    Eigen::Index const opposite = scene.opposite_nodes[at];  // feels the opposite friction
    pressure[opposite] = pressure[node];
    friction.col(opposite) = -friction.col(node);
    state[opposite] = state[node];
  }
  slant::vtu_grid grid(scene.mesh.nodes, encoding);
  grid.add_cells(D == 2 ? slant::vtu_cell::triangle : slant::vtu_cell::tetrahedron,
                 scene.mesh.cells);
  grid.add_point_vectors("displacement", scene.displacement(u));
  grid.add_point_scalars("contact_pressure", pressure);
  grid.add_point_vectors("friction", friction);
  grid.add_point_scalars("contact_state", state);
  grid.write(file);
}

}  // namespace fem
