// SPDX-License-Identifier: MIT
//
// What a reader wants to see of a flow along its stick–slip wall: shear stress, its bound, slip.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <vector>

#include <fem/stokes_dual.hpp>
#include <fem/stokes_scene.hpp>

namespace fem {

/// stick: the fluid adheres to the wall. slip: it moves along it.
enum class wall_state : unsigned char { stick, slip };

/// One entry per wall node, in the order of the scene.
struct wall_field {
  Eigen::VectorXd along;     ///< u_t, velocity in the direction of the tangent
  Eigen::VectorXd across;    ///< u_n, zero up to the accuracy of the solution
  Eigen::VectorXd shear;     ///< σ_t = −λ_t/ω − κ u_t, force per length
  Eigen::VectorXd friction;  ///< σ_t + κ u_t, the part of it that g bounds
  Eigen::VectorXd bound;     ///< g
  std::vector<wall_state> state;

  [[nodiscard]] Eigen::Index size() const { return shear.size(); }
  [[nodiscard]] Eigen::Index count(wall_state which) const {
    Eigen::Index n = 0;
    for (wall_state s : state) n += s == which ? 1 : 0;
    return n;
  }
};

/// The field of a solution. Scale-free: a node slips when |λ_t + k u_t| > ω g, where k is the
/// stiffness of the node in the direction of its tangent; at a solution one of |λ_t| − ω g and u_t
/// is zero, so a rounding error is compared with a quantity of the data.
[[nodiscard]] inline wall_field make_wall_field(stokes_scene const& scene,
                                                stokes_solution const& solution) {
  Eigen::Index const m = scene.wall_count();
  require(solution.tangential.size() == m, "tangential", solution.tangential.size(),
          "one entry per wall node");
  require(solution.u.size() == scene.velocity_count(), "u", solution.u.size(),
          "one entry per velocity unknown");
  Eigen::VectorXd ω(m);
  for (Eigen::Index i = 0; i < m; ++i) ω[i] = scene.wall[static_cast<std::size_t>(i)].weight;

  wall_field field;
  field.along = scene.T * solution.u;
  field.across = scene.N * solution.u;
  field.friction = -solution.tangential.cwiseQuotient(ω);
  field.shear = field.friction - scene.adhesion.cwiseProduct(field.along);
  field.bound = scene.g.cwiseQuotient(ω);
  Eigen::VectorXd const k = scene.T.cwiseAbs2() * scene.A.diagonal();
  for (Eigen::Index i = 0; i < m; ++i) {
    double const trial = solution.tangential[i] + k[i] * field.along[i];
    field.state.push_back(std::abs(trial) > scene.g[i] ? wall_state::slip : wall_state::stick);
  }
  return field;
}

}  // namespace fem
