// SPDX-License-Identifier: MIT
//
// What is given of a stationary Stokes flow with stick–slip walls [K (23)]:
//
//     −ν Δu + ∇p = f,   ∇·u = 0   in Ω,         σ = ν du/dn − p n
//     u = u_D on γ_D,   σ = σ_N on γ_N,
//     u_n = 0,   u_t = 0 ⇒ |σ_t| ≤ g,   σ_t u_t + g |u_t| + κ u_t² = 0   on γ_C
//
// Where the fluid slips, σ_t = −g sign(u_t) − κ u_t: a bound as in Tresca's law, and Navier's law.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include <fem/planar_domain.hpp>

namespace fem {

/// The data. Functions of the place are called while the problem is set up, and only then.
struct stokes_flow {
  using point = Eigen::Vector2d;

  planar_domain domain;
  std::vector<std::string> dirichlet{};  ///< parts of the boundary that make up γ_D
  std::string wall{};                    ///< γ_C; the other parts are γ_N
  double viscosity = 1;                  ///< ν > 0
  std::function<point(point const&)> velocity = [](point const&) -> point {
    return {0, 0};
  };                                                                                        ///< u_D
  std::function<point(point const&)> force = [](point const&) -> point { return {0, 0}; };  ///< f
  /// σ_N at a place, given the outer normal there.
  std::function<point(point const&, point const&)> stress = [](point const&,
                                                               point const&) -> point {
    return {0, 0};
  };
  std::function<double(point const&)> slip_bound = [](point const&) {
    return 0.0;
  };  ///< g ≥ 0, or ∞
  std::function<double(point const&)> adhesion = [](point const&) { return 0.0; };  ///< κ ≥ 0
};

}  // namespace fem
