// SPDX-License-Identifier: MIT
#include <slant/contact/friction/verify.hpp>
#include <slant/contact/solve_friction.hpp>

#include <doctest/doctest.h>

TEST_CASE("contacts in local coordinates") {
  Eigen::MatrixXd const W = Eigen::MatrixXd::Identity(6, 6);
  Eigen::VectorXd const q{{-1.0, 0.1, 0.0, -2.0, 0.0, 3.0}};
  Eigen::VectorXd const mu{{0.5, 0.5}};

  // u = W r + q; [n, t₁, t₂] of each contact, r in the cones of friction
  slant::contact::friction_problem<double> const problem{.W = W.sparseView(), .q = q, .mu = mu};
  auto const s = slant::contact::solve_friction(problem);
  if (!s.converged()) FAIL(s.reason);                       // else s.r, s.u
  auto const check = slant::contact::verify(problem, s.r);  // independent of all solvers

  // One contact sticks, the other slips at its bound.
  CHECK(check.stick == 1);
  CHECK(check.slip == 1);
  CHECK(s.r[0] == doctest::Approx(1.0));
  CHECK(s.r[1] == doctest::Approx(-0.1));
  CHECK(s.r[3] == doctest::Approx(2.0));
  CHECK(s.r[5] == doctest::Approx(-1.0));
}
