// SPDX-License-Identifier: MIT
//
// Decomposed bricks and their undecomposed twins.
#pragma once

#include <slant/contact/rigid_body_modes.hpp>
#include <slant/contact/total_feti.hpp>
#include <slant/iteration/feasible.hpp>
#include <slant/iteration/solve.hpp>

#include <doctest/doctest.h>

#include <fem/decomposition.hpp>
#include <fem/steel_brick.hpp>

#include <array>

namespace test {

/// A brick of cubes of c × c × c cells, one for each subdomain.
struct decomposed_brick {
  fem::contact_scene<3> scene;
  fem::decomposed_scene parts;
  slant::contact::floating_bodies<double> bodies;

  decomposed_brick(std::array<int, 3> const& cuts, int c, fem::brick_load load) {
    auto const mesh = fem::make_box_mesh<3>({cuts[0] * c, cuts[1] * c, cuts[2] * c},
                                            Eigen::Vector3d(cuts[0], cuts[1], cuts[2]));
    auto const loading = fem::loading_of(load);
    auto const steel = fem::lame(2.119e5, 0.277);
    scene = fem::make_contact_scene<3>({.mesh = mesh,
                                        .material = steel,
                                        .fixed = fem::brick_side::left,
                                        .contact = fem::brick_side::bottom,
                                        .loads = loading.tractions,
                                        .slip_bound = loading.slip_bound});
    parts = fem::decompose<3>(scene, steel, fem::box_partition<3>(mesh, cuts));
    bodies.K = parts.K;
    for (auto const& nodes : parts.nodes) {
      bodies.R.push_back(slant::contact::rigid_body_modes(nodes));
    }
    bodies.B = parts.glue;
    bodies.c = Eigen::VectorXd::Zero(parts.glue.rows());
  }

  /// Contact data for the unknowns of all subdomains.
  [[nodiscard]] slant::contact::data<double> data(bool friction) const {
    if (friction) return {parts.N, parts.T, parts.f, scene.d, scene.g};
    return {parts.N, Eigen::SparseMatrix<double>(0, parts.unknowns()), parts.f, scene.d,
            Eigen::VectorXd(0)};
  }
};

inline auto accurate() {
  return (slant::reduced_gradient_below(1e-10) && slant::feasibility_below(1e-10)) ||
         slant::at_most(100);
}

/// Displacements of the scene, the mean of the copies, which must agree with each other.
template <class Problem, class Method>
Eigen::VectorXd displacement(decomposed_brick const& brick, Problem const& problem,
                             Method const& method) {
  auto const r = slant::solve(method, problem.zero(), accurate());
  CAPTURE(r.reason);
  CHECK(r.converged());
  CHECK(r.iterations() <= 30);
  Eigen::VectorXd const u = problem.displacement(r.x(), method.multipliers(r.state));
  CHECK((brick.parts.glue * u).norm() <= 1e-8 * u.norm());
  return brick.parts.mean * u;
}

}  // namespace test
