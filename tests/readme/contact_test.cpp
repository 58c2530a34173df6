// SPDX-License-Identifier: MIT
//
// The contact problem of README.md.
#include <fem/steel_brick.hpp>
#include <slant/contact/contact.hpp>
#include <slant/factorizations/static_condensation.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/methods/unconstrained_start.hpp>

#include <doctest/doctest.h>

TEST_CASE("a contact problem from matrices") {
  auto const scene = fem::make_steel_brick({.k = 2, .load = fem::brick_load::lift});
  Eigen::SparseMatrix<double> const& K = scene.K;
  slant::contact::data<double> const data{scene.N, scene.T, scene.f, scene.d, scene.g};

  slant::static_condensation const factor(K, slant::contact::contact_unknowns(data));
  slant::contact::dual const problem(slant::contact::friction_disc{}, factor, data);
  auto const M = slant::contact::lumped_preconditioner(K, problem.constraints());
  auto const qp = problem.qp();
  auto const start = slant::unconstrained_start(qp, M);
  auto const run = slant::solve(slant::symmetric_newton{qp, M}, start.x,
                                slant::reduced_gradient_below(1e-10) || slant::at_most(100));
  Eigen::VectorXd const u = problem.displacement(run.x());

  CHECK(run.converged());
  CHECK(slant::contact::check_optimality(K, data, u, run.x()).residual() <= 1e-8);
}
