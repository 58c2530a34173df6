// SPDX-License-Identifier: MIT
//
// Decomposed bricks and their undecomposed twins.
#pragma once

#include <slant/iteration/solve.hpp>
#include <slant/iteration/stopping.hpp>

#include <doctest/doctest.h>

#include <fem/decomposed_brick.hpp>
#include <support/floating_parts.hpp>

#include <array>

namespace test {

/// A brick of cubes of c × c × c cells, one for each subdomain.
struct decomposed_brick : fem::decomposed_brick {
  slant::contact::floating_bodies<double> bodies;

  decomposed_brick(std::array<int, 3> const& cubes, int c, fem::brick_load load)
      : fem::decomposed_brick(
            fem::make_decomposed_brick({.cubes = cubes, .cells = c, .load = load})),
        bodies(examples::floating_parts(parts)) {}

  /// Contact data for the unknowns of all subdomains.
  [[nodiscard]] slant::contact::data<double> data(bool friction) const {
    return examples::contact_data(scene, parts, friction);
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
