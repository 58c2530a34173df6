// SPDX-License-Identifier: MIT
#include "mixture.hpp"

#include <slant/iteration/solve.hpp>
#include <slant/methods/kprgp.hpp>
#include <slant/operators/counted.hpp>

#include <slant/operators/diagonal.hpp>
#include <slant/sets/cartesian.hpp>
#include <slant/sets/contact_sets.hpp>
#include <slant/sets/ellipse.hpp>
#include <slant/sets/point.hpp>
#include <slant/sets/second_order_cone.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <krylov/spd_matrices.hpp>
#include <limits>
#include <oracle/certificate.hpp>
#include <oracle/dense_newton.hpp>

namespace kprgp_test {

using Eigen::VectorXd;

using test::mixture;

TEST_CASE("kprgp agrees with Newton's method on dense data, whatever its options") {
  for (double κ : {1.0, 30.0, 1000.0}) {
    CAPTURE(κ);
    mixture const p(κ);
    auto const reference = oracle::solve_dense(p.plain());
    auto const A = test::spd(p.A);
    auto const qp = slant::separable_qp{A, p.b, p.set()};
    for (auto const& o :
         {slant::kprgp_options<double>{}, slant::kprgp_options<double>{.proportioning = 0.01},
          slant::kprgp_options<double>{.proportioning = 100},
          slant::kprgp_options<double>{.step_factor = 0.5},
          slant::kprgp_options<double>{.half_step = false},
          slant::kprgp_options<double>{.refresh = 1}, slant::kprgp_options<double>{.refresh = 0}}) {
      auto const r = slant::solve(slant::kprgp{qp, o}, VectorXd(VectorXd::Zero(20)),
                                  slant::reduced_gradient_below(1e-13) || slant::at_most(100000));
      REQUIRE(r.converged());
      CHECK((r.x() - reference.x.cast<double>()).norm() <= 1e-11 * κ * r.x().norm());
      CHECK(oracle::certify(p.plain(), r.x().cast<long double>()).energy_error < 1e-6);
    }
  }
}

TEST_CASE("without constraints kprgp is the method of conjugate gradients") {
  auto const M = test::with_spectrum(test::log_spaced(30, 100));
  VectorXd const x = test::random_vector(30), b = M * x;
  auto const A = test::spd(M);
  auto const qp = slant::separable_qp{A, b, slant::free_components(30)};
  auto const r = slant::solve(slant::kprgp{qp, {.step_length = 1.0}}, VectorXd(VectorXd::Zero(30)),
                              slant::reduced_gradient_below(1e-12) || slant::at_most(60));
  REQUIRE(r.converged());
  CHECK((r.x() - x).norm() <= 1e-9 * x.norm());
  CHECK(r.state.work.operator_applications == r.iterations() + r.iterations() / 50 + 1);
  // One more computes r from x before success is claimed.
}

TEST_CASE("cones, ellipses, points and other blocks") {
  auto const M = test::with_spectrum(test::log_spaced(11, 50));
  VectorXd const b = test::random_vector(11);
  auto const A = test::spd(M);
  auto const set = slant::cartesian(slant::power(slant::second_order_cone<3>(0.3), 2),
                                    slant::ellipse<>(2.0, 0.1),
                                    slant::point<1>(Eigen::Matrix<double, 1, 1>(0.25)),
                                    slant::interval<>(0.5, 0.5), slant::ball<1>(0.0));
  auto const qp = slant::separable_qp{A, b, set};
  auto const r = slant::solve(slant::kprgp{qp, {.step_factor = 1.0}}, VectorXd(VectorXd::Zero(11)),
                              slant::reduced_gradient_below(1e-12) || slant::at_most(20000));
  REQUIRE(r.converged());
  // Variational inequality against many feasible points: rᵀ(z − x) ≥ 0.
  VectorXd const gradient = M * r.x() - b;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    VectorXd const z = slant::project(set, VectorXd(3 * test::random_vector(11, seed)));
    CHECK(gradient.dot(z - r.x()) >= -1e-10 * gradient.norm() * (z - r.x()).norm());
  }
  CHECK(r.x()(8) == 0.25);
  CHECK(r.x()(9) == 0.5);
  CHECK(r.x()(10) == 0.0);
}

TEST_CASE("the report counts every product, and a given step length saves those for σ_max") {
  mixture const p(1000);
  auto const A = test::spd(p.A);
  auto const set = p.set();
  auto const run = [&](auto const& options) {
    auto const counting = slant::counted(A);
    auto const qp = slant::separable_qp{counting, p.b, set};
    auto const r =
        slant::solve(slant::kprgp{qp, options}, VectorXd(VectorXd::Zero(20)), slant::at_most(100));
    CHECK(counting.applications() ==
          r.state.work.operator_applications + r.state.work.setup_applications);
    return r.state.work;
  };
  CHECK(run(slant::kprgp_options<double>{}).setup_applications > 0);
  CHECK(run(slant::kprgp_options<double>{.step_length = 1.0}).setup_applications == 0);
}

}  // namespace kprgp_test
