// SPDX-License-Identifier: MIT
//
// A Bingham fluid (mud, paste) pressed through a round pipe: it flows where the shear stress exceeds
// g and moves as a rigid plug, or not at all, where it does not. The velocity u minimises
//
//     ½ ∫ η|∇u|² − ∫ f u + ∫ g|∇u|,      u = 0 at the wall;   discretised  ½ uᵀK u − fᵀu + Σ gₖ‖(T u)ₖ‖
//
// with linear elements, T u the gradients times the roots of the areas, one pair a triangle. Σ gₖ‖wₖ‖
// is the support function of the discs of radii gₖ, so the dual problem is
//
//     minimise ½ λᵀA λ − bᵀλ over λ ∈ discs,    A = T K⁻¹Tᵀ,  b = T K⁻¹f,    u = K⁻¹(f − Tᵀλ).
//
// As K = η TᵀT, η A is the projector onto the range of T: singular, for there are more gradients than
// velocities. λ is not unique, A λ and u are. But for rounding, conjugate gradients do not leave the
// range of Π A Π, and symmetric_newton takes the problem as it is; for a reduced gradient below 1e-9
// a step may spend all of its inner steps on what rounding leaves.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <fem/simplex_mesh.hpp>
#include <numbers>
#include <slant/factorizations/factorize.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/operators/operators.hpp>
#include <slant/problems/minimise.hpp>
#include <slant/sets/contact_sets.hpp>
#include <vector>

namespace bingham {

using Eigen::Index;
using vector = Eigen::VectorXd;

struct fluid {
  double η = 1;    ///< viscosity
  double g = 0.2;  ///< yield stress
  double f = 1;    ///< fall of pressure along the pipe
  double R = 1;    ///< its radius
};

/// The closed form of Buckingham and Reiner.
[[nodiscard]] inline double plug_radius(fluid const& p) {
  return std::min(2 * p.g / p.f, p.R);
}
[[nodiscard]] inline double velocity(fluid const& p, double r) {
  double const s = std::max(r, plug_radius(p));
  return ((p.R * p.R - s * s) * p.f / 4 - (p.R - s) * p.g) / p.η;
}
[[nodiscard]] inline double flow_rate(fluid const& p) {
  double const s = plug_radius(p) / p.R;
  return std::numbers::pi * p.f * std::pow(p.R, 4) / (8 * p.η) *
         (1 - 4 * s / 3 + std::pow(s, 4) / 3);
}

/// The disc by m rings, ring k of 6k nodes; those of the last one come last.
[[nodiscard]] inline fem::simplex_mesh<2> disc_mesh(int m, double R) {
  auto const node = [](int ring, int j) {
    return ring == 0 ? 0 : 1 + 3 * ring * (ring - 1) + j % (6 * ring);
  };
  fem::simplex_mesh<2> mesh;
  mesh.nodes.setZero(2, 1 + 3 * m * (m + 1));
  mesh.cells.resize(3, 6 * m * m);
  Index cell = 0;
  for (int k = 1; k <= m; ++k) {
    for (int j = 0; j < 6 * k; ++j) {
      double const angle = j * std::numbers::pi / (3 * k);
      mesh.nodes.col(node(k, j)) = R * k / m * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      int const inner = j - j / k;  // each of the six sectors has one less inside
      mesh.cells.col(cell++) << node(k - 1, inner), node(k, j), node(k, j + 1);
      if (j % k != k - 1)
        mesh.cells.col(cell++) << node(k - 1, inner), node(k, j + 1), node(k - 1, inner + 1);
    }
  }
  return mesh;
}

/// K, T, f and the radii gₖ without the nodes at the wall.
struct pipe {
  Eigen::Matrix2Xd nodes;
  Eigen::SparseMatrix<double> K, T;
  vector f, radii;
  vector node_areas;  ///< their product with u is the flow rate
  vector areas;       ///< of the triangles
};

[[nodiscard]] inline pipe discretised(fluid const& p, int m) {
  auto const mesh = disc_mesh(m, p.R);
  Index const n = mesh.node_count() - 6 * m, cells = mesh.cell_count();
  pipe d;
  d.nodes = mesh.nodes.leftCols(n);
  d.node_areas.setZero(n);
  d.areas.resize(cells);
  std::vector<Eigen::Triplet<double>> entries;
  for (Index k = 0; k < cells; ++k) {
    auto const element = fem::element_of(mesh, k);
    d.areas[k] = element.volume;
    for (int a = 0; a < 3; ++a) {
      int const i = mesh.cells(a, k);
      if (i >= n) continue;
      d.node_areas[i] += element.volume / 3;
      Eigen::Vector2d const t = std::sqrt(element.volume) * element.gradients.col(a);
      for (int c = 0; c < 2; ++c) entries.emplace_back(int(2 * k + c), i, t[c]);
    }
  }
  d.T.resize(2 * cells, n);
  d.T.setFromTriplets(entries.begin(), entries.end());
  d.K = p.η * d.T.transpose() * d.T;
  d.f = p.f * d.node_areas;
  d.radii = p.g * d.areas.cwiseSqrt();
  return d;
}

struct flow {
  vector u;
  double rate, plug_radius;  ///< of the disc that has the area of the triangles without shear
  double energy_error;  ///< ‖u − u*‖_K to the discrete solution u*, at most: the square root of
                        ///< the duality gap
  slant::status status;
  slant::index steps, products;
};

[[nodiscard]] inline flow solve(pipe const& d, double tolerance) {
  auto const K = slant::op<"K">(slant::factorize(d.K));
  auto const T = slant::op<"T">(d.T);
  auto const A = T * inverse(K) * adjoint(T);
  vector const b = T * inverse(K) * d.f;
  auto const program = slant::minimise(slant::quadratic(A, b)).over(slant::discs(d.radii));
  auto const run = slant::solve(slant::symmetric_newton{program}, vector(vector::Zero(b.size())),
                                slant::reduced_gradient_below(tolerance) || slant::at_most(100));
  vector const force = d.f - d.T.transpose() * run.x();
  vector const u = inverse(K) * force, shear = d.T * u;
  double gap = 0, plug = 0;
  for (Index k = 0; k < d.radii.size(); ++k) {
    auto const s = shear.segment<2>(2 * k), λ = run.x().segment<2>(2 * k);
    gap += std::max(0.0, d.radii[k] * s.norm() - λ.dot(s));
    if (λ.norm() < (1 - 1e-9) * d.radii[k]) plug += d.areas[k];
  }
  auto const& work = run.state.work;
  return {u,
          d.node_areas.dot(u),
          std::sqrt(plug / std::numbers::pi),
          std::sqrt(gap),
          run.status,
          run.iterations(),
          work.operator_applications + work.setup_applications};
}

}  // namespace bingham
