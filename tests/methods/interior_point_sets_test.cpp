// SPDX-License-Identifier: MIT
#include <slant/iteration/solve.hpp>
#include <slant/methods/interior_point.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/sets/sets.hpp>

#include <doctest/doctest.h>

#include <krylov/spd_matrices.hpp>
#include <limits>

namespace interior_point_sets_test {

using Eigen::VectorXd;

/// A block of every kind, and images of some: 30 unknowns.
auto every_kind() {
  double const infinity = std::numeric_limits<double>::infinity();
  Eigen::Matrix2d const turn{{0.6, -0.8}, {0.8, 0.6}};
  return slant::cartesian(
      slant::half_lines(VectorXd{{0.0, -1.0, 0.5, -infinity}}), slant::interval<>(-0.1, 0.2),
      slant::interval<>(0.3, infinity), slant::discs<slant::planar>(VectorXd{{0.5, infinity, 2.0}}),
      slant::ellipse<>(2.0, 0.1), slant::power(slant::second_order_cone<3>(0.5), 2),
      slant::shifted(slant::rotated(slant::ellipse<>(1.0, 0.3), turn), Eigen::Vector2d(1.0, 1.0)),
      slant::scaled(0.25, slant::ball<3>(1.0)), slant::point<2>(Eigen::Vector2d(0.7, -0.2)),
      slant::free_components(3));
}

TEST_CASE("a product of all blocks: the solution of the symmetric Newton method") {
  auto const set = every_kind();
  slant::index const n = slant::dimension_of(set);
  for (unsigned seed = 1; seed <= 4; ++seed) {
    CAPTURE(seed);
    auto const A = test::spd(test::with_spectrum(test::log_spaced(n, 100), seed));
    VectorXd const b = 2 * test::random_vector(n, seed + 10);
    slant::separable_qp const qp{A, b, set};
    for (double size : {0.0, 1e3}) {
      CAPTURE(size);
      VectorXd const x0 = size * test::random_vector(n, 5);
      auto const exact = slant::solve(slant::symmetric_newton{qp}, x0,
                                      slant::reduced_gradient_below(1e-13) || slant::at_most(200));
      REQUIRE(exact.converged());
      auto const r = slant::solve(slant::interior_point{qp}, x0,
                                  slant::reduced_gradient_below(1e-10) || slant::at_most(60));
      CHECK(r.converged());
      CHECK((r.x() - exact.x()).norm() <= 1e-7 * exact.x().norm());
      CHECK(set.contains(r.x()));
      auto const& s = r.state;
      CHECK(s.multipliers.minCoeff() >= 0);
      CHECK(s.slacks.minCoeff() > 0);
    }
  }
}

TEST_CASE("along curved boundaries the reduced gradient falls as fast as the products") {
  // Centred by c = 1/5, ϑ falls by 5 in a step: 6 digits take 9 steps, and one more is granted.
  auto const set = every_kind();
  slant::index const n = slant::dimension_of(set);
  VectorXd const zero = VectorXd::Zero(n);
  for (unsigned seed = 1; seed <= 4; ++seed) {
    CAPTURE(seed);
    auto const A = test::spd(test::with_spectrum(test::log_spaced(n, 100), seed));
    slant::separable_qp const qp{A, VectorXd(2 * test::random_vector(n, seed + 10)), set};
    auto const steps = [&](double target) {
      auto const r = slant::solve(slant::interior_point{qp}, zero,
                                  slant::reduced_gradient_below(target) || slant::at_most(60));
      CHECK(r.converged());
      return r.iterations();
    };
    CHECK(steps(1e-10) - steps(1e-4) <= 10);
  }
}

TEST_CASE(
    "free blocks have no multiplier and no slack, points and infinite bounds count for nothing") {
  auto const set = every_kind();
  slant::barrier<double> const barrier(set);
  // half lines 4, intervals 2 · 2, discs 3, ellipse 1, cones 2 · 2, image 1, ball 1
  CHECK(barrier.rows() == 18);
  CHECK(slant::barrier<double>(slant::free_components(7)).rows() == 0);
  static_assert(slant::free_space<2>::inequalities == 0);
  static_assert(
      decltype(slant::cartesian(slant::free_space<2>{}, slant::ball<2>{}))::inequalities == 1);
  slant::index const n = slant::dimension_of(set);
  auto const A = test::spd(test::with_spectrum(test::log_spaced(n, 10)));
  VectorXd const b = test::random_vector(n);
  slant::separable_qp const qp{A, b, set};
  slant::interior_point const method{qp};
  auto s = method.start(VectorXd(VectorXd::Zero(n)));
  CHECK(s.constraints == 15);
  for (int k = 0; k < 5; ++k) method.step(s);
  CHECK((s.multipliers.array() == 0).count() == 3);
  CHECK(s.x.segment(n - 5, 2) == Eigen::Vector2d(0.7, -0.2));
}

TEST_CASE("a narrow cone at an angle: no axis leads from its apex to the inside") {
  auto const set = slant::power(slant::rotated(slant::second_order_cone<2>(0.3),
                                               Eigen::Matrix2d(Eigen::Rotation2Dd(0.785).matrix())),
                                4);
  auto const A = test::spd(test::with_spectrum(test::log_spaced(8, 10), 3));
  slant::separable_qp const qp{A, VectorXd(test::random_vector(8, 4)), set};
  VectorXd const zero = VectorXd::Zero(8);
  auto const exact = slant::solve(slant::symmetric_newton{qp}, zero,
                                  slant::reduced_gradient_below(1e-13) || slant::at_most(300));
  REQUIRE(exact.converged());
  auto const r = slant::solve(slant::interior_point{qp}, zero,
                              slant::reduced_gradient_below(1e-9) || slant::at_most(80));
  CHECK(r.converged());
  CHECK((r.x() - exact.x()).norm() <= 1e-6 * exact.x().norm());
}

TEST_CASE("cones of any opening: apex, mantle and interior") {
  for (double μ : {1e-3, 0.5, 1.0, 30.0}) {
    CAPTURE(μ);
    auto const set = slant::power(slant::second_order_cone<3>(μ), 8);
    auto const A = test::spd(test::with_spectrum(test::log_spaced(24, 30), 7));
    VectorXd const b = test::random_vector(24, 21);
    slant::separable_qp const qp{A, b, set};
    VectorXd const zero = VectorXd::Zero(24);
    auto const exact = slant::solve(slant::symmetric_newton{qp}, zero,
                                    slant::reduced_gradient_below(1e-13) || slant::at_most(300));
    REQUIRE(exact.converged());
    auto const r = slant::solve(slant::interior_point{qp}, zero,
                                slant::reduced_gradient_below(1e-9) || slant::at_most(80));
    CHECK(r.converged());
    CHECK((r.x() - exact.x()).norm() <= 1e-6 * exact.x().norm());
  }
}

}  // namespace interior_point_sets_test
