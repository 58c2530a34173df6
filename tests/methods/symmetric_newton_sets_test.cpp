// SPDX-License-Identifier: MIT
//
// Every kind of set whose projection has a symmetric slanting operator, against a method that
// uses projections only.
#include <slant/iteration/solve.hpp>
#include <slant/methods/kprgp.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/sets/cartesian.hpp>
#include <slant/sets/contact_sets.hpp>
#include <slant/sets/ellipse.hpp>
#include <slant/sets/point.hpp>
#include <slant/sets/power.hpp>
#include <slant/sets/rotated.hpp>
#include <slant/sets/scaled.hpp>
#include <slant/sets/second_order_cone.hpp>
#include <slant/sets/shifted.hpp>

#include <doctest/doctest.h>

#include <krylov/spd_matrices.hpp>

namespace symmetric_newton_sets_test {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

/// Ellipses, balls in space, cones, images of discs and ellipses, intervals, points, free ones.
auto all_sets() {
  Eigen::Matrix2d turn;
  turn << 0.8, -0.6, 0.6, 0.8;
  return slant::cartesian(
      slant::power(slant::ellipse(2.0, 0.25), 2), slant::power(slant::ball<3>(0.7), 2),
      slant::power(slant::second_order_cone<3>(0.4), 3),
      slant::shifted(slant::ball<2>(0.5), Vector2d(1.0, -1.0)),
      slant::scaled(3.0, slant::ellipse(0.2, 0.1)), slant::rotated(slant::ellipse(1.0, 0.1), turn),
      slant::intervals(VectorXd{{0.3, 0.0}}), slant::point<2>(Vector2d(0.1, 0.2)),
      slant::half_lines(VectorXd{{0.2, -1.0}}), slant::free_components(2));
}

TEST_CASE("every set: the solution of projected gradients, in a few superlinear steps") {
  auto const set = all_sets();
  auto const n = set.size();
  for (unsigned seed = 1; seed <= 6; ++seed) {
    CAPTURE(seed);
    MatrixXd const M = test::with_spectrum(test::log_spaced(n, 30), seed);
    auto const A = test::spd(M);
    VectorXd const b = 4 * test::random_vector(n, seed + 50);
    slant::separable_qp const qp{A, b, set};
    VectorXd const x0 = 10 * test::random_vector(n, seed + 90);
    auto const exact = slant::solve(slant::kprgp{qp}, x0,
                                    slant::reduced_gradient_below(1e-13) || slant::at_most(50000));
    REQUIRE(exact.converged());
    auto const r = slant::solve(slant::symmetric_newton{qp}, x0,
                                slant::reduced_gradient_below(1e-13) || slant::at_most(60));
    CHECK(r.converged());
    CHECK(r.state.descent.count() == 0);
    CHECK(r.iterations() <= 25);
    CHECK((r.x() - exact.x()).norm() <= 1e-10 * exact.x().norm());
    CHECK(set.contains(r.x()));
    CHECK(r.state.work.operator_applications < exact.state.work.operator_applications);
  }
}

TEST_CASE("warm start: from the solution of a neighbour, and from the solution itself") {
  auto const set = all_sets();
  auto const n = set.size();
  auto const A = test::spd(test::with_spectrum(test::log_spaced(n, 30), 3));
  VectorXd const b = 4 * test::random_vector(n, 53),
                 neighbour = b + 1e-3 * test::random_vector(n, 7);
  auto const stop = slant::reduced_gradient_below(1e-11) || slant::at_most(60);
  auto const first = slant::solve(slant::symmetric_newton{slant::separable_qp{A, b, set}},
                                  VectorXd(VectorXd::Zero(n)), stop);
  REQUIRE(first.converged());
  slant::separable_qp const qp{A, neighbour, set};
  auto const cold = slant::solve(slant::symmetric_newton{qp}, VectorXd(VectorXd::Zero(n)), stop);
  auto const warm = slant::solve(slant::symmetric_newton{qp}, first.x(), stop);
  REQUIRE(cold.converged());
  REQUIRE(warm.converged());
  CHECK(warm.iterations() <= 4);
  CHECK(warm.iterations() < cold.iterations());
  CHECK(warm.state.work.operator_applications < cold.state.work.operator_applications);
  auto const again = slant::solve(slant::symmetric_newton{qp}, warm.x(), stop);
  CHECK(again.iterations() == 0);
}

}  // namespace symmetric_newton_sets_test
