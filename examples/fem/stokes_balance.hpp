// SPDX-License-Identifier: MIT
//
// Is it a solution? The conditions of [K (23), (26)], computed from the scene and the solution in
// physical units, by no code that any method uses.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include <fem/stokes_dual.hpp>
#include <fem/stokes_flow.hpp>
#include <fem/stokes_scene.hpp>

namespace fem {

/// Violations. All but the flows are relative: 0 at the solution, 1 is as wrong as nothing at all.
struct stokes_balance {
  double momentum;     ///< ‖A_κ u + Cᵀλ − l‖ over the sum of the norms of its terms
  double mass;         ///< ‖B u − E p − c‖ over the same
  double penetration;  ///< max |u_n| over the largest velocity
  double above_bound;  ///< max (|λ_t,i| − ω g)₊ over max |λ_t,i|
  /// The law of the wall: max |λ_t − P(λ_t + k u_t)| over max (|λ_t| + k |u|), P the projection
  /// onto |λ_t| ≤ ω g, k the stiffness of the node, which makes velocities comparable with forces.
  double wrong_slip;
  double inflow;   ///< ∮ (−u·n)₊ over the edges outside the wall, volume per time
  double outflow;  ///< ∮ (u·n)₊

  /// The largest violation; NaN if one is.
  [[nodiscard]] double residual() const {
    double largest = 0;
    for (double const v : {momentum, mass, penetration, above_bound, wrong_slip}) {
      if (std::isnan(v)) return v;
      largest = std::max(largest, v);
    }
    return largest;
  }
};

/// The violations of a solution. Through single edges of a curved wall something flows although
/// u_n = 0 at their nodes, in here and out there; the sum over the wall is zero, see wall_nodes.
[[nodiscard]] inline stokes_balance check_balance(stokes_flow const& flow,
                                                  stokes_scene const& scene,
                                                  stokes_solution const& s) {
  auto const over = [](double part, double whole) { return part == 0 ? 0.0 : part / whole; };
  Eigen::Matrix2Xd const velocity = scene.velocity(s.u);
  double const speed = velocity.colwise().norm().maxCoeff();
  stokes_balance balance{};

  Eigen::VectorXd const Au = scene.A * s.u;
  Eigen::VectorXd const wall = scene.T.transpose() * s.tangential + scene.N.transpose() * s.normal;
  Eigen::VectorXd const Bp = scene.B.transpose() * s.p;
  balance.momentum =
      over((Au + wall + Bp - scene.l).norm(), Au.norm() + wall.norm() + Bp.norm() + scene.l.norm());
  Eigen::VectorXd const Bu = scene.B * s.u;
  Eigen::VectorXd const Ep = scene.E * s.p;
  balance.mass = over((Bu - Ep - scene.c).norm(), Bu.norm() + Ep.norm() + scene.c.norm());

  if (scene.wall_count() > 0) {
    Eigen::ArrayXd const u_t = (scene.T * s.u).array();
    Eigen::ArrayXd const λ_t = s.tangential.array();
    balance.penetration = over((scene.N * s.u).cwiseAbs().maxCoeff(), speed);
    balance.above_bound =
        over(std::max(0.0, (λ_t.abs() - scene.g.array()).maxCoeff()), λ_t.abs().maxCoeff());
    Eigen::ArrayXd const k = (scene.T.cwiseAbs2() * scene.A.diagonal()).array();
    Eigen::ArrayXd const bound = scene.g.array();
    Eigen::ArrayXd const allowed = (λ_t + k * u_t).max(-bound).min(bound);
    balance.wrong_slip = over((λ_t - allowed).abs().maxCoeff(), (λ_t.abs() + k * speed).maxCoeff());
  }
  int const wall_part = flow.wall.empty() ? -1 : flow.domain.part(flow.wall);
  for (auto const& edge : flow.domain.boundary) {
    if (edge.part == wall_part) continue;
    double const out =
        flow.domain.outward(edge).dot(velocity.col(edge.from) + velocity.col(edge.to)) / 2;
    (out < 0 ? balance.inflow : balance.outflow) += std::abs(out);
  }
  return balance;
}

}  // namespace fem
