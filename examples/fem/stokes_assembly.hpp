// SPDX-License-Identifier: MIT
//
// The matrices and vectors of a Stokes flow, triangle by triangle, edge by edge, and node by node
// of the wall. Velocities of Dirichlet nodes are no unknowns; their products go to l and c.
#pragma once

#include <Eigen/SparseCore>
#include <cmath>
#include <cstddef>
#include <vector>

#include <fem/mini_element.hpp>
#include <fem/stokes_flow.hpp>
#include <fem/stokes_system.hpp>
#include <fem/triangle_quadrature.hpp>

namespace fem {

namespace detail {

/// Sums entries of elements in the order of the elements, alike on both sides of the diagonal.
using triplets = std::vector<Eigen::Triplet<double>>;

[[nodiscard]] inline Eigen::SparseMatrix<double> assembled(Eigen::Index rows, Eigen::Index cols,
                                                           triplets const& entries) {
  Eigen::SparseMatrix<double> matrix(rows, cols);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// A without κ, B, E, l, c of all triangles.
inline void assemble_triangles(stokes_flow const& flow, stokes_scene& scene) {
  auto const& mesh = scene.mesh;
  triplets A, B, E;
  for (Eigen::Index cell = 0; cell < mesh.cell_count(); ++cell) {
    auto const element = element_of<2>(mesh, cell);
    mini_element const mini(element, flow.viscosity);
    Eigen::Matrix<double, 2, 3> load = Eigen::Matrix<double, 2, 3>::Zero();  // ∫ f φ_a
    Eigen::Vector2d bubble_load(0, 0);                                       // ∫ f β
    for (auto const& q : triangle_points()) {
      Eigen::Vector2d x(0, 0);
      for (int a = 0; a < 3; ++a) x += q.at[a] * mesh.nodes.col(mesh.cells(a, cell));
      Eigen::Vector2d const f = q.weight * element.volume * flow.force(x);
      load += f * q.at.transpose();
      bubble_load += mini_element::bubble_at(q.at) * f;
    }
    Eigen::Vector3d const c = mini.divergence_of_bubble_load(bubble_load);
    auto const D = mini.divergence();
    for (int b = 0; b < 3; ++b) {
      int const node = mesh.cells(b, cell);
      int const column = scene.unknowns.first[node];
      scene.c[node] += c[b];
      scene.pressure_mass[node] += element.volume / 3;
      if (column >= 0) scene.l.segment<2>(column) += load.col(b);
      for (int a = 0; a < 3; ++a) {
        int const other = mesh.cells(a, cell);
        int const row = scene.unknowns.first[other];
        E.emplace_back(other, node, mini.stabilisation()(a, b));
        if (column < 0) {  // a given velocity: its products go to the right-hand sides
          Eigen::Vector2d const given = scene.dirichlet.col(node);
          scene.c[other] -= D.col(b).dot(given);
          if (row >= 0) scene.l.segment<2>(row) -= mini.stiffness()(a, b) * given;
          continue;
        }
        for (int i = 0; i < 2; ++i) {
          B.emplace_back(other, column + i, D(i, b));
          if (row >= 0) A.emplace_back(row + i, column + i, mini.stiffness()(a, b));
        }
      }
    }
  }
  Eigen::Index const n = scene.unknowns.count;
  scene.A = assembled(n, n, A);
  scene.B = assembled(mesh.node_count(), n, B);
  scene.E = assembled(mesh.node_count(), mesh.node_count(), E);
}

/// Adds ∫ σ_N·v over the edges of one part of γ_N to l.
inline void add_stress(stokes_flow const& flow, int part, stokes_scene& scene) {
  for (auto const& edge : flow.domain.boundary) {
    if (edge.part != part) continue;
    Eigen::Vector2d const from = scene.mesh.nodes.col(edge.from);
    Eigen::Vector2d const along = flow.domain.along(edge);
    double const length = along.norm();
    Eigen::Vector2d const n = flow.domain.outward(edge) / length;
    for (auto const& q : edge_points()) {
      Eigen::Vector2d const σ = q.weight * length * flow.stress(from + q.at * along, n);
      if (!scene.unknowns.is_fixed(edge.from))
        scene.l.segment<2>(scene.unknowns.first[edge.from]) += (1 - q.at) * σ;
      if (!scene.unknowns.is_fixed(edge.to))
        scene.l.segment<2>(scene.unknowns.first[edge.to]) += q.at * σ;
    }
  }
}

/// T, N, g, κ of the wall, and the boundary mass of κ in A_κ by the same trapezoidal rule as g, so
/// that the law of the wall holds node by node.
inline void assemble_wall(stokes_flow const& flow, int part, stokes_scene& scene) {
  scene.wall =
      wall_nodes(flow.domain, part, [&](int node) { return !scene.unknowns.is_fixed(node); });
  auto const m = static_cast<Eigen::Index>(scene.wall.size());
  Eigen::Index const n = scene.unknowns.count;
  scene.g.resize(m);
  scene.adhesion.resize(m);
  triplets T, N, K;
  for (Eigen::Index i = 0; i < m; ++i) {
    auto const& at = scene.wall[static_cast<std::size_t>(i)];
    Eigen::Vector2d const x = scene.mesh.nodes.col(at.node);
    double const g = flow.slip_bound(x);
    double const κ = flow.adhesion(x);
    require(g >= 0, "slip_bound", g, "a number >= 0");
    require(κ >= 0 && std::isfinite(κ), "adhesion", κ, "a finite number >= 0");
    scene.g[i] = at.weight * g;
    scene.adhesion[i] = κ;
    int const first = scene.unknowns.first[at.node];
    for (int a = 0; a < 2; ++a) {
      T.emplace_back(i, first + a, at.tangent[a]);
      N.emplace_back(i, first + a, at.normal[a]);
      for (int b = 0; b < 2; ++b)
        K.emplace_back(first + a, first + b, at.weight * κ * (at.tangent[a] * at.tangent[b]));
    }
  }
  scene.T = assembled(m, n, T);
  scene.N = assembled(m, n, N);
  scene.A += assembled(n, n, K);
  scene.A.makeCompressed();
}

}  // namespace detail

}  // namespace fem
