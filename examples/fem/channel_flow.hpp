// SPDX-License-Identifier: MIT
//
// The flow in a channel around a round obstacle on which the fluid may slip [K Ex 4]: the channel
// (−0.2, 2) × (−0.2, 0.2) without the disc of radius 0.05 at the origin, f = 0, ν = 1, u = 0 on the
// channel's walls, u = (7.5 (0.04 − y²), 0) where the fluid enters, σ = 0 where it leaves.
#pragma once

#include <fem/gmsh_mesh.hpp>
#include <fem/stokes_scene.hpp>

namespace fem {

/// What can be varied about the channel.
struct channel_options {
  double slip_bound = 10;  ///< g; at 10 the fluid sticks and slips, at 30 it only sticks
  double adhesion = 0;     ///< κ
};

/// The flow on a mesh whose boundary has the parts inflow, walls, outflow and obstacle.
[[nodiscard]] inline stokes_flow make_channel_flow(planar_domain domain,
                                                   channel_options const& options = {}) {
  stokes_flow flow;
  flow.domain = std::move(domain);
  flow.dirichlet = {"walls", "inflow"};
  flow.wall = "obstacle";
  flow.velocity = [](Eigen::Vector2d const& x) -> Eigen::Vector2d {
    bool const enters = x[0] < 0 && std::abs(x[1]) < 0.2;
    return {enters ? 7.5 * (0.04 - x[1] * x[1]) : 0, 0};
  };
  double const g = options.slip_bound;
  double const κ = options.adhesion;
  flow.slip_bound = [g](Eigen::Vector2d const&) { return g; };
  flow.adhesion = [κ](Eigen::Vector2d const&) { return κ; };
  return flow;
}

}  // namespace fem
