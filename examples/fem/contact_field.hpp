// SPDX-License-Identifier: MIT
//
// What a reader wants to see of a contact solution: stresses and the state of each contact node.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <cmath>
#include <cstddef>
#include <vector>

#include <fem/contact_scene.hpp>

namespace fem {

/// open: no contact. stick: in contact and held by friction. slip: in contact and sliding.
enum class contact_state : unsigned char { open, stick, slip };

/// Stresses on the contact side of a body in D dimensions, one entry (or column) per contact node.
template <int D>
struct contact_field {
  surface_patch<D> side;                  ///< the whole contact side
  std::vector<surface_patch<D>> patches;  ///< where: rectangles or intervals of the contact side
  Eigen::VectorXd normal;                 ///< pressure λ_ν/ω, force per area
  Eigen::Matrix<double, D - 1, Eigen::Dynamic> friction;  ///< traction −λ_t/ω on the (first) body
  Eigen::VectorXd slip_bound;                             ///< g/ω, force per area
  std::vector<contact_state> state;
  /// Friction has its largest value. In Tresca's law, where the bound is given, also at open nodes.
  std::vector<bool> at_slip_bound;

  [[nodiscard]] Eigen::Index size() const { return normal.size(); }
  [[nodiscard]] Eigen::Index count(contact_state which) const {
    Eigen::Index n = 0;
    for (contact_state s : state) n += s == which ? 1 : 0;
    return n;
  }
};

/// What friction on the contact side of a scene acts against, if not what the scene says.
struct friction_step {
  Eigen::VectorXd slip_bound;  ///< g as a force, m; of Coulomb's law F λ_ν
  Eigen::VectorXd start;       ///< T u at the beginning of the step, (D−1) m
};

/// The field of a solution (u, λ_ν, λ_t). Scale-free: a node is open unless λ_ν/k exceeds its gap,
/// and it slips when ‖λ_t + k T u‖ > g, where k is the stiffness K_ii of the node; at a solution
/// one side of each comparison is zero, so a rounding error is compared with a quantity of the
/// data. Throws std::invalid_argument when a size does not fit the scene.
template <int D>
[[nodiscard]] contact_field<D> make_contact_field(contact_scene<D> const& scene,
                                                  friction_step const& friction,
                                                  Eigen::VectorXd const& u,
                                                  Eigen::VectorXd const& normal,
                                                  Eigen::VectorXd const& tangential) {
  Eigen::Index const m = scene.contact_count();
  require(friction.slip_bound.size() == m, "slip_bound", friction.slip_bound.size(),
          "one entry per contact node");
  require(friction.start.size() == scene.T.rows(), "start", friction.start.size(),
          "one entry per row of T");
  require(u.size() == scene.K.rows(), "u", u.size(), "one entry per unknown of the scene");
  require(normal.size() == m, "normal", normal.size(), "one entry per contact node");
  require(tangential.size() == (D - 1) * m, "tangential", tangential.size(),
          D == 3 ? "two per contact node" : "one per contact node");

  contact_field<D> field;
  field.side = scene.contact_side;
  field.patches = scene.contact_patches;
  field.friction.resize(D - 1, m);
  field.state.resize(static_cast<std::size_t>(m));
  field.at_slip_bound.resize(static_cast<std::size_t>(m));
  field.normal = normal.cwiseQuotient(scene.contact_weights);
  field.slip_bound = friction.slip_bound.cwiseQuotient(scene.contact_weights);

  Eigen::VectorXd const k = scene.N.cwiseAbs() * scene.K.diagonal();
  Eigen::VectorXd const gap = scene.d - scene.N * u;
  Eigen::VectorXd const motion = scene.T * u - friction.start;
  for (Eigen::Index i = 0; i < m; ++i) {
    auto const λ_t = tangential.segment<D - 1>((D - 1) * i);
    field.friction.col(i) = -λ_t / scene.contact_weights[i];
    bool const closed = normal[i] / k[i] > gap[i];
    bool const slips =
        (λ_t + k[i] * motion.segment<D - 1>((D - 1) * i)).norm() > friction.slip_bound[i];
    auto const at = static_cast<std::size_t>(i);
    field.state[at] = !closed ? contact_state::open
                      : slips ? contact_state::slip
                              : contact_state::stick;
    field.at_slip_bound[at] = slips && (closed || friction.slip_bound[i] > 0);
  }
  return field;
}

/// With Tresca's bounds of the scene, from rest.
template <int D>
[[nodiscard]] contact_field<D> make_contact_field(contact_scene<D> const& scene,
                                                  Eigen::VectorXd const& u,
                                                  Eigen::VectorXd const& normal,
                                                  Eigen::VectorXd const& tangential) {
  return make_contact_field<D>(scene, {scene.g, Eigen::VectorXd::Zero(scene.T.rows())}, u, normal,
                               tangential);
}

}  // namespace fem
