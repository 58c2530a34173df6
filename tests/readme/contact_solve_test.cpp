// SPDX-License-Identifier: MIT
#include <slant/contact/optimality.hpp>
#include <slant/contact/plausibility.hpp>
#include <slant/contact/solve.hpp>

#include <doctest/doctest.h>

#include <Eigen/SparseCore>
#include <iostream>

TEST_CASE("contact of one node") {
  // A node on a rigid floor, pressed down and pulled along it: u = (into the floor, along it, across).
  Eigen::Matrix3d const stiffness{{2, -1, 0}, {-1, 2, 0}, {0, 0, 2}};
  Eigen::SparseMatrix<double> const K = stiffness.sparseView();
  Eigen::SparseMatrix<double> const I = Eigen::Matrix3d::Identity().sparseView();
  slant::contact::data<double> const data{.N = I.topRows(1),
                                          .T = I.bottomRows(2),
                                          .f = Eigen::Vector3d(1, 2, 0),
                                          .d = Eigen::VectorXd::Zero(1),
                                          .g = Eigen::VectorXd::Constant(1, 0.5)};

  slant::contact::friction_disc const law;  // with the law named no other is compiled
  auto const r = slant::contact::solve(law, K, data, {.tolerance = 1e-8});
  if (!r.converged()) FAIL(r.reason);
  // r.u = (0, 0.75, 0): it slides; forces r.multipliers = (1.75, 0.5, 0)
  double const error = r.error.relative();  // an estimate; {.prove = true}: a bound

  CHECK(error <= 1e-8);
  CHECK((r.u - Eigen::Vector3d(0, 0.75, 0)).norm() <= 1e-8);
  CHECK((r.multipliers - Eigen::Vector3d(1.75, 0.5, 0)).norm() <= 1e-8);

  auto const warnings = slant::contact::check_plausibility(K, data);  // valid data that look wrong
  for (auto const& warning : warnings) std::cerr << warning.text << '\n';
  auto const seen = slant::contact::check_optimality(K, data, r.u, r.multipliers);
  if (seen.residual() > 1e-6) FAIL("relative KKT residual ", seen.residual());
}
