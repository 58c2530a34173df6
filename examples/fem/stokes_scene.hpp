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
#include <cmath>
#include <vector>

#include <fem/mini_element.hpp>
#include <fem/stokes_flow.hpp>
#include <fem/triangle_quadrature.hpp>
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
