// SPDX-License-Identifier: MIT
//
// A Stokes flow with stick–slip walls, discretised by P1-bubble/P1 elements [K §2.2.2, (26)]: the
// saddle point of
//
//     L(u; λ_t, λ_n, p) = ½ uᵀA_κ u − lᵀu − ½ pᵀE p − cᵀp + λ_tᵀT u + λ_nᵀN u + pᵀB u,
//     |λ_t,i| ≤ ω_i g(x_i):       A_κ u + Tᵀλ_t + Nᵀλ_n + Bᵀp = l,   N u = 0,   B u − E p = c.
//
// The printed (26) writes B u = 0 for the last equation; with condensed bubbles and eliminated
// Dirichlet velocities E and c are not zero. λ_t,i has the sign of (T u)_i, and the shear stress is
// σ_t = −λ_t/ω − κ u_t.
#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include <fem/simplex_mesh.hpp>
#include <fem/unknowns.hpp>
#include <fem/wall_nodes.hpp>

namespace fem {

/// Matrices and vectors of the discrete problem, and the map back to the mesh.
struct stokes_scene {
  Eigen::SparseMatrix<double> A;  ///< A_κ, n_u × n_u, positive definite, both triangles
  Eigen::SparseMatrix<double> B;  ///< −divergence of affine velocities, n_p × n_u
  Eigen::SparseMatrix<double> E;  ///< what the bubbles leave behind, n_p × n_p, semidefinite
  Eigen::SparseMatrix<double> T;  ///< tangential velocity of the wall nodes, m × n_u
  Eigen::SparseMatrix<double> N;  ///< normal velocity of the wall nodes, m × n_u
  Eigen::VectorXd l;              ///< load, n_u
  Eigen::VectorXd c;              ///< right-hand side of the continuity equation, n_p
  Eigen::VectorXd g;              ///< slip bound of each wall node as a force, ω_i g(x_i), m
  Eigen::VectorXd adhesion;       ///< κ(x_i), m
  Eigen::VectorXd pressure_mass;  ///< ∫ φ_i, n_p
  std::vector<wall_node> wall;    ///< m nodes of γ_C that are not on γ_D
  double viscosity;
  simplex_mesh<2> mesh;
  unknown_map unknowns;        ///< node → its two velocity unknowns; fixed on γ_D
  Eigen::Matrix2Xd dirichlet;  ///< u_D at the nodes of γ_D, 0 elsewhere; one column per node

  [[nodiscard]] Eigen::Index velocity_count() const { return A.rows(); }
  [[nodiscard]] Eigen::Index pressure_count() const { return E.rows(); }
  [[nodiscard]] Eigen::Index wall_count() const { return g.size(); }

  /// Velocity of every mesh node, one column each.
  [[nodiscard]] Eigen::Matrix2Xd velocity(Eigen::VectorXd const& u) const {
    return dirichlet + nodal_displacement<2>(unknowns, u);
  }
};

}  // namespace fem
