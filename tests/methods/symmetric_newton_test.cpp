// SPDX-License-Identifier: MIT
#include "mixture.hpp"

#include <slant/iteration/solve.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/newton/semismooth_newton.hpp>
#include <slant/operators/counted.hpp>
#include <slant/slanting/natural_residual.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <oracle/dense_newton.hpp>

namespace symmetric_newton_test {

using Eigen::VectorXd;

/// All inner systems solved to the last digit that the scalar has.
template <class S>
slant::symmetric_newton_options<S> exactly(double tolerance) {
  slant::symmetric_newton_options<S> o;
  o.forcing = {.γ = tolerance, .exponent = 2, .η_max = tolerance, .η_first = tolerance};
  return o;
}

TEST_CASE("the same steps as Newton's method for the natural residual") {
  test::mixture const p(100);
  auto const A = test::spd(p.A);
  auto const set = p.set();
  slant::separable_qp const qp{A, p.b, set};
  VectorXd const x0 = VectorXd::Zero(20);
  slant::symmetric_newton method{qp, exactly<double>(1e-14)};
  auto s = method.start(x0);
  slant::semismooth_newton const generic{slant::natural_residual(A, p.b, set, s.step_length),
                                         slant::direct_solver{}};
  auto g = generic.start(s.x);
  int compared = 0;
  for (int k = 0; k < 12 && s.status == slant::status::running; ++k) {
    method.step(s);
    if (s.step_fraction != 1.0) break;  // the two searches differ
    generic.step(g);
    if (g.length != 1.0) break;
    CAPTURE(k);
    CHECK((s.segment.y - g.x).norm() <= 1e-10 * (1 + g.x.norm()));
    ++compared;
  }
  CHECK(compared >= 3);
  auto const r = slant::solve(generic, x0, slant::residual_below(1e-13) || slant::at_most(100));
  auto const ours =
      slant::solve(method, x0, slant::reduced_gradient_below(1e-13) || slant::at_most(100));
  REQUIRE(r.converged());
  REQUIRE(ours.converged());
  CHECK((ours.x() - r.x()).norm() <= 1e-11 * r.x().norm());
}

TEST_CASE("a mixture of all constraints, from anywhere, with any preconditioner") {
  for (double κ : {1e2, 1e6, 1e10}) {
    CAPTURE(κ);
    test::mixture const p(κ);
    auto const A = test::spd(p.A);
    auto const set = p.set();
    slant::separable_qp const qp{A, p.b, set};
    auto const reference = oracle::solve_dense(p.plain());
    VectorXd const exact = reference.x.cast<double>();
    Eigen::MatrixXd const inverse = p.A.inverse();
    auto const M = test::spd(Eigen::MatrixXd((inverse + inverse.transpose()) / 2));
    auto const stop = slant::reduced_gradient_below(1e-11) || slant::at_most(500);
    for (double size : {0.0, 1.0, 1e10}) {
      CAPTURE(size);
      VectorXd const x0 = size * test::random_vector(20, 17);
      for (auto const& r : {slant::solve(slant::symmetric_newton{qp}, x0, stop)}) {
        CHECK(r.converged());
        CHECK((r.x() - exact).norm() <= 1e-11 * κ * exact.norm());
        CHECK(set.contains(r.x()));
      }
      auto const r = slant::solve(slant::symmetric_newton{qp, M}, x0, stop);
      CHECK(r.converged());
      CHECK((r.x() - exact).norm() <= 1e-11 * κ * exact.norm());
    }
  }
}

TEST_CASE("what is counted, and one product a Newton step besides those of its inner iterations") {
  test::mixture const p(100);
  auto const A = slant::counted(test::spd(p.A));
  slant::separable_qp const qp{A, p.b, p.set()};
  slant::symmetric_newton method{qp};
  auto s = method.start(VectorXd(VectorXd::Zero(20)));
  CHECK(s.work.setup_applications == 0);  // A knows its diagonal
  // P_Λ(0) is not 0 in this set: its gradient and, in the first step, that of P_Λ(z).
  CHECK(A.applications() == 1);
  for (int k = 0; k < 30 && s.status == slant::status::running; ++k) {
    auto const before = A.applications();
    method.step(s);
    CHECK(A.applications() - before == s.inner_iterations + (k == 0 ? 2 : 1));
    CHECK(A.applications() == s.work.operator_applications);
    CHECK((s.unit * s.r - (p.A * s.x - p.b)).norm() <= 1e-13 * p.b.norm());
    if (s.reduced_gradient_norm <= 1e-10 * s.gradient_scale) break;
  }
  CHECK(s.reduced_gradient_norm <= 1e-10 * s.gradient_scale);
  CHECK(s.descent.count() == 0);
  CHECK_FALSE(s.descent.state().has_value());  // not even its memory
}

}  // namespace symmetric_newton_test
