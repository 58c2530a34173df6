// SPDX-License-Identifier: MIT
#include "bodies_scenes.hpp"

#include <doctest/doctest.h>

#include <fem/elastic_torsion.hpp>
#include <fem/stacked_bricks.hpp>
#include <fem/steel_brick.hpp>
#include <fem/string_1d.hpp>
#include <fem/two_bricks.hpp>
#include <fem/two_plates.hpp>
#include <support/dense_of.hpp>
#include <support/effort.hpp>

namespace bodies_agreement_test {

using namespace bodies_scenes;
using bodies_scenes::by_dual;  // beside the one for stacks

TEST_CASE("one body on a foundation, two bodies in the plane and in space: as the dual methods") {
  for (auto const load : fem::brick_loads) {
    CAPTURE(fem::name_of(load));
    compare(fem::make_steel_brick({.k = test::effort(4, 2), .load = load}));
  }
  compare(fem::make_two_plates(test::effort(8, 3)));
  compare(fem::make_two_bricks(test::effort(6, 4)));
}

TEST_CASE("the wire above a bound, a membrane between two obstacles: as the dual methods") {
  // The components of the wire are two bodies; of the membrane every unknown is constrained.
  auto const wire = fem::make_wire(16);
  for (double const bound : {-1.0, 0.0}) {
    sparse N(wire.m, wire.A.rows());
    for (Eigen::Index i = 0; i < wire.m; ++i) N.insert(i, i) = -1;
    VectorXd const d = VectorXd::Constant(wire.m, -bound);
    compare(contact::bodies<double>(wire.A, wire.b, N, d), by_dual(wire.A, wire.b, N, d));
  }
  auto const bar = fem::make_elastic_torsion(6, 5, 10.0);
  sparse const A = test::dense_of(bar.A).sparseView();
  Eigen::Index const n = bar.b.size();
  sparse N(2 * n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    N.insert(i, i) = 1;
    N.insert(n + i, i) = -1;
  }
  VectorXd d(2 * n);
  d << bar.upper, -bar.lower;
  compare(contact::bodies<double>(A, bar.b, N, d), by_dual(A, bar.b, N, d));
}

/// A stack has a singular K. Springs that pull rows of B to their bounds, which they reach at the
/// solution anyway, change nothing there and make K definite. Which rows these are may be guessed
/// in any way: that the springs are at rest in the end is checked.
answer by_dual(fem::stack_scene const& scene, VectorXd const& springs) {
  double const stiffness = scene.K.diagonal().mean();
  sparse const K =
      scene.K + stiffness * sparse(scene.B.transpose() * springs.asDiagonal() * scene.B);
  VectorXd const f = scene.f + stiffness * scene.B.transpose() * springs.cwiseProduct(scene.c);
  auto const found = by_dual(K, f, scene.B, scene.c);
  // Otherwise it would be another problem.
  VectorXd const stretch = springs.cwiseProduct(scene.B * found.u - scene.c);
  REQUIRE(stretch.norm() <= 1e-11 * found.u.norm());
  return found;
}

TEST_CASE("floating bricks, held by contact alone: as the dual methods") {
  for (double const gap : {0.0, 1e-5}) {
    auto const scene = fem::make_stack({.gap = gap});
    contact::bodies<double> const bodies(scene.K, scene.f, scene.B, scene.c);
    CHECK(bodies.count() == 2);
    CHECK(bodies.idle() == 0);
    CHECK(bodies.fixed() == 0);
    auto const active = run(bodies);
    REQUIRE(active.converged());
    VectorXd const λ = active.state.multipliers();
    CHECK((λ.array() == 0).any());  // something has opened
    VectorXd const springs = (λ.array() > 1e-3 * λ.maxCoeff()).cast<double>();
    compare(bodies, by_dual(scene, springs));
  }
}

}  // namespace bodies_agreement_test
