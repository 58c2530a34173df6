// SPDX-License-Identifier: MIT
//
// Stiffness of isotropic linear elasticity with P1 elements, in the plane (D = 2) and in space (D =
// 3):
//
//   uᵀK v = ∫ λ (div u)(div v) + 2 μ ε(u) : ε(v),        ε(u) = ½ (∇u + ∇uᵀ)
#pragma once

#include <Eigen/SparseCore>
#include <cmath>

#include <fem/require.hpp>
#include <fem/simplex_mesh.hpp>
#include <fem/unknowns.hpp>

namespace fem {

/// Lamé parameters, in the unit of Young's modulus.
struct lame_parameters {
  double lambda;
  double mu;
};

/// Three-dimensional body, or plane strain. E > 0 and -1 < ν < ½, else std::invalid_argument.
[[nodiscard]] inline lame_parameters lame(double E, double nu) {
  require(E > 0 && std::isfinite(E), "E", E, "a positive finite Young modulus");
  require(nu > -1 && nu < 0.5, "nu", nu, "a Poisson ratio in (-1, 1/2)");
  return {.lambda = E * nu / ((1 + nu) * (1 - 2 * nu)), .mu = E / (2 * (1 + nu))};
}

/// Plane stress [K Ex 5]: λ = Eν/(1−ν²), μ = E/(2(1+ν)). Same conditions as lame.
[[nodiscard]] inline lame_parameters lame_plane_stress(double E, double nu) {
  lame_parameters const solid = lame(E, nu);
  return {.lambda = E * nu / (1 - nu * nu), .mu = solid.mu};
}

/// Stiffness of one element; rows and columns D a … D a + D − 1 belong to vertex a. With g_a the
/// gradients of the hat functions, block (a, b) is  V [λ g_a g_bᵀ + μ (g_b g_aᵀ + g_aᵀg_b I)].
template <int D>
[[nodiscard]] Eigen::Matrix<double, D*(D + 1), D*(D + 1)> element_stiffness(
    p1_element<D> const& element, lame_parameters const& material) {
  using block = Eigen::Matrix<double, D, D>;
  Eigen::Matrix<double, D*(D + 1), D*(D + 1)> K;
  for (int a = 0; a <= D; ++a)
    for (int b = 0; b <= a; ++b) {
      auto const ga = element.gradients.col(a);
      auto const gb = element.gradients.col(b);
      K.template block<D, D>(D * a, D * b) =
          element.volume *
          (material.lambda * ga * gb.transpose() + material.mu * gb * ga.transpose() +
           material.mu * ga.dot(gb) * block::Identity());
    }
  // Mirrored, because the products above are symmetric only up to rounding.
  K.template triangularView<Eigen::StrictlyUpper>() = K.transpose();
  return K;
}

/// Stiffness on the unknowns of a mesh; the rows and columns of fixed nodes are left out, which is
/// the elimination of homogeneous Dirichlet conditions. Both triangles are stored, symmetric bit
/// for bit.
template <int D>
[[nodiscard]] Eigen::SparseMatrix<double> stiffness(simplex_mesh<D> const& mesh,
                                                    unknown_map const& unknowns,
                                                    lame_parameters const& material) {
  Eigen::SparseMatrix<double> K(unknowns.count, unknowns.count);
  // A node of a Kuhn mesh has 2^(D+1) − 2 neighbours; other meshes only pay for a reallocation.
  K.reserve(Eigen::VectorXi::Constant(unknowns.count, D * ((2 << D) - 1)));
  for (Eigen::Index cell = 0; cell < mesh.cell_count(); ++cell) {
    auto const Ke = element_stiffness<D>(element_of<D>(mesh, cell), material);
    for (int b = 0; b <= D; ++b) {
      int const column = unknowns.first[mesh.cells(b, cell)];
      if (column < 0) continue;
      for (int a = 0; a <= D; ++a) {
        int const row = unknowns.first[mesh.cells(a, cell)];
        if (row < 0) continue;
        for (int j = 0; j < D; ++j)
          for (int i = 0; i < D; ++i) K.coeffRef(row + i, column + j) += Ke(D * a + i, D * b + j);
      }
    }
  }
  K.makeCompressed();
  return K;
}

}  // namespace fem
