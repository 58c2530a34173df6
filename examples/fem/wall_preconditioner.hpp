// SPDX-License-Identifier: MIT
//
// An approximate inverse of the dual Stokes operator in balanced units, whose quality does not
// depend on the mesh:
//
//     M = [ W       ]      W = Ω^½ (Ω^{-½} K Ω^{-½} + ℓ⁻² I)^½ Ω^½,   Ω = diag(ω),
//         [   W     ]
//         [       I ]      K = stiffness of −d²/ds² along the wall, ℓ its length over 2π.
//
// A maps forces on the wall to velocities of the wall: a force of wave number k moves the fluid by
// 1/(2νk), which is the operator (−d²/ds²)^{-½} up to a factor [Steklov–Poincaré]; without W the
// long waves are worse than the short ones by the number of nodes. The pressures of the balanced
// problem need nothing, as B A_κ⁻¹Bᵀ + E is then within constants of I.
#pragma once

#include <slant/operators/matrix.hpp>

#include <Eigen/Eigenvalues>
#include <numbers>

#include <fem/stokes_scene.hpp>

namespace fem {

/// W, m × m and dense: a square root by eigenvalues, O(m³) once and m² a product. Throws
/// std::invalid_argument if the eigenvalues are not found.
[[nodiscard]] inline Eigen::MatrixXd wall_half_norm(planar_domain const& domain,
                                                    stokes_scene const& scene) {
  Eigen::Index const m = scene.wall_count();
  Eigen::VectorXi number = Eigen::VectorXi::Constant(scene.mesh.node_count(), -1);
  Eigen::VectorXd root(m);
  for (Eigen::Index i = 0; i < m; ++i) {
    auto const& at = scene.wall[static_cast<std::size_t>(i)];
    number[at.node] = static_cast<int>(i);
    root[i] = std::sqrt(at.weight);
  }
  Eigen::MatrixXd L = Eigen::MatrixXd::Zero(m, m);
  double length = 0;
  for (auto const& edge : domain.boundary) {
    int const a = number[edge.from];
    int const b = number[edge.to];
    if (a < 0 && b < 0) continue;
    double const h = domain.along(edge).norm();
    length += h;
    if (a < 0 || b < 0) continue;  // the end of an open wall
    L(a, a) += 1 / (h * root[a] * root[a]);
    L(b, b) += 1 / (h * root[b] * root[b]);
    L(a, b) -= 1 / (h * root[a] * root[b]);
    L(b, a) = L(a, b);
  }
  L.diagonal().array() += std::pow(2 * std::numbers::pi / length, 2);
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> const eigen(L);
  require(eigen.info() == Eigen::Success, "wall", m, "edges with finite lengths");
  Eigen::MatrixXd const V = root.asDiagonal() * eigen.eigenvectors();
  Eigen::MatrixXd W = V * eigen.eigenvalues().cwiseSqrt().asDiagonal() * V.transpose();
  W.triangularView<Eigen::StrictlyUpper>() = W.transpose();
  return W;
}

/// M for a scene of this domain and its stokes_dual in balanced units.
[[nodiscard]] inline auto wall_preconditioner(planar_domain const& domain,
                                              stokes_scene const& scene) {
  Eigen::MatrixXd const W = wall_half_norm(domain, scene);
  Eigen::Index const m = W.rows();
  Eigen::Index const n = 2 * m + scene.pressure_count();
  detail::triplets entries;
  for (Eigen::Index j = 0; j < m; ++j)
    for (Eigen::Index i = 0; i < m; ++i)
      for (Eigen::Index const part : {Eigen::Index(0), m})
        entries.emplace_back(part + i, part + j, W(i, j));
  for (Eigen::Index i = 2 * m; i < n; ++i) entries.emplace_back(i, i, 1.0);
  return slant::matrix<slant::self_adjoint, slant::positive_definite>(
      detail::assembled(n, n, entries));
}

}  // namespace fem
