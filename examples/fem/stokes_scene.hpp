// SPDX-License-Identifier: MIT
//
// From the data of a Stokes flow with stick–slip walls to its discrete problem [K §2.2.2].
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include <fem/stokes_assembly.hpp>
#include <fem/stokes_flow.hpp>
#include <fem/stokes_system.hpp>

namespace fem {

/// Discretises a flow. Throws std::invalid_argument for a part of the boundary that the mesh does
/// not have, a boundary without Dirichlet or without Neumann edges (p would be known up to a
/// constant), a negative slip bound, or a viscosity or adhesion out of range.
[[nodiscard]] inline stokes_scene make_stokes_scene(stokes_flow const& flow) {
  require(flow.viscosity > 0 && std::isfinite(flow.viscosity), "viscosity", flow.viscosity,
          "a positive finite number");
  int const wall = flow.wall.empty() ? -1 : flow.domain.part(flow.wall);
  std::vector<bool> given(flow.domain.parts.size(), false);
  for (auto const& name : flow.dirichlet)
    given[static_cast<std::size_t>(flow.domain.part(name))] = true;

  stokes_scene scene;
  scene.viscosity = flow.viscosity;
  scene.mesh = flow.domain.mesh;
  Eigen::Index const nodes = scene.mesh.node_count();
  std::vector<bool> fixed(static_cast<std::size_t>(nodes), false);
  Eigen::Index given_edges = 0;
  Eigen::Index free_edges = 0;
  for (auto const& edge : flow.domain.boundary) {
    bool const is_given = given[static_cast<std::size_t>(edge.part)];
    (is_given ? given_edges : free_edges) += is_given || edge.part != wall ? 1 : 0;
    if (!is_given) continue;
    fixed[static_cast<std::size_t>(edge.from)] = true;
    fixed[static_cast<std::size_t>(edge.to)] = true;
  }
  require(given_edges > 0, "edges with a given velocity", given_edges, "at least one");
  require(free_edges > 0, "edges with a given stress", free_edges, "at least one");

  scene.unknowns = number_unknowns(
      scene.mesh, [&](Eigen::Index node) { return fixed[static_cast<std::size_t>(node)]; });
  scene.dirichlet = Eigen::Matrix2Xd::Zero(2, nodes);
  for (Eigen::Index node = 0; node < nodes; ++node)
    if (scene.unknowns.is_fixed(node))
      scene.dirichlet.col(node) = flow.velocity(scene.mesh.nodes.col(node));
  scene.l = Eigen::VectorXd::Zero(scene.unknowns.count);
  scene.c = Eigen::VectorXd::Zero(nodes);
  scene.pressure_mass = Eigen::VectorXd::Zero(nodes);

  detail::assemble_triangles(flow, scene);
  for (int part = 0; part < static_cast<int>(given.size()); ++part)
    if (!given[static_cast<std::size_t>(part)] && part != wall)
      detail::add_stress(flow, part, scene);
  detail::assemble_wall(flow, wall, scene);
  return scene;
}

}  // namespace fem
