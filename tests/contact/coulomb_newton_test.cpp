// SPDX-License-Identifier: MIT
#include <slant/contact/coulomb/coulomb.hpp>

#include "coulomb_scenes.hpp"

#include <slant/contact/load_stepper.hpp>
#include <slant/factorizations/ldlt.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/newton/krylov_solvers.hpp>

#include <fem/two_plates.hpp>
#include <support/testing.hpp>

namespace coulomb_newton_test {

auto stop(double tolerance) {
  return slant::residual_below(tolerance) || slant::at_most(100);
}

TEST_CASE("both residuals on the brick: the law, each other, and the work of Tresca's problem") {
  for (auto const load : fem::brick_loads) {
    CAPTURE(fem::name_of(load));
    auto const s = fem::make_steel_brick({.k = test::effort(4, 2), .load = load});
    auto const c = test::contact_data(s);
    auto const factor = slant::ldlt(s.K);
    contact::dual problem(contact::friction_disc{}, factor, c);
    VectorXd const μ = VectorXd::Constant(c.d.size(), 0.3);
    contact::coulomb_cones const cones(problem, μ);
    double const ρ = contact::residual_step(cones).length;
    auto const F = contact::coulomb_residual(cones, ρ);
    auto const G = contact::de_saxce_residual(cones, ρ);
    auto const by_F = slant::solve(contact::coulomb_newton(F), cones.zero(), stop(1e-13));
    auto const by_G = slant::solve(contact::coulomb_newton(G), cones.zero(), stop(1e-13));
    REQUIRE(by_F.converged());
    REQUIRE(by_G.converged());
    CHECK((by_F.x() - by_G.x()).norm() <= 1e-8 * by_F.x().norm());
    VectorXd const λ = cones.by_directions(by_F.x());
    CHECK(test::natural_map(test::dense_dual(s.K, c), μ, λ) <= 1e-10);

    double const goal = 1e-8;
    problem.update_bounds(μ.cwiseProduct(λ.head(μ.size()).cwiseMax(0)));
    slant::symmetric_newton_options<double> o;
    o.forcing.goal = goal;
    auto const tresca = slant::solve(slant::symmetric_newton{problem.qp(), o}, problem.zero(),
                                     slant::reduced_gradient_below(goal) || slant::at_most(100));
    REQUIRE(tresca.converged());
    auto const limit = 8 * tresca.state.work.operator_applications / 5;  // 1.6 times
    for (auto const& work :
         {slant::solve(contact::coulomb_newton(F, goal), cones.zero(), stop(goal)).state.work,
          slant::solve(contact::coulomb_newton(G, goal), cones.zero(), stop(goal)).state.work}) {
      CHECK(work.operator_applications > 0);
      CHECK(work.operator_applications <= limit);
    }
  }
}

TEST_CASE("load steps: the residual refers to the data and sees new ones") {
  auto const s = fem::make_steel_brick({.k = 2, .load = fem::brick_load::pull});
  auto c = test::contact_data(s);
  auto const factor = slant::ldlt(s.K);
  contact::dual problem(contact::friction_disc{}, factor, c);
  VectorXd const μ = VectorXd::Constant(c.d.size(), 0.3);
  contact::coulomb_cones cones(problem, μ);
  auto const F = contact::coulomb_residual(cones, contact::residual_step(cones).length);
  contact::load_stepper stepper(cones, contact::coulomb_newton(F), stop(1e-12));
  REQUIRE(stepper.advance({}).converged());
  VectorXd const w = 1e-7 * VectorXd::LinSpaced(c.T.rows(), -1, 1);
  c.f *= 1.02;
  auto const& step = stepper.advance({.f = c.f, .w = w});
  REQUIRE(step.converged());
  test::dense_dual dense(s.K, c);
  dense.b.tail(w.size()) -= w;
  CHECK(test::natural_map(dense, μ, cones.by_directions(step.x())) <= 1e-9);
}

TEST_CASE("plates in the plane: another linear solver; no friction") {
  auto const s = fem::make_two_plates(4);
  contact::data<double> const c{s.N, s.T, s.f, s.d, s.g};
  auto const factor = slant::ldlt(s.K);
  contact::dual problem(contact::friction_line{}, factor, c);
  test::dense_dual const dense(s.K, c);
  for (double const F : {0.0, 0.3, 1.0}) {
    CAPTURE(F);
    VectorXd const μ = VectorXd::Constant(c.d.size(), F);
    contact::coulomb_cones const cones(problem, μ);
    auto const G = contact::coulomb_residual(cones, contact::residual_step(cones).length);
    auto const r = slant::solve(contact::coulomb_newton(G), cones.zero(), stop(1e-13));
    REQUIRE(r.converged());
    CHECK(test::natural_map(dense, μ, cones.by_directions(r.x())) <= 1e-9);
    auto const other = slant::solve(
        slant::semismooth_newton{G, slant::bicgstab_solver{}, slant::halving_line_search{}},
        cones.zero(), stop(1e-12));
    REQUIRE(other.converged());
    CHECK((other.x() - r.x()).norm() <= 1e-8 * r.x().norm());
  }
}

}  // namespace coulomb_newton_test
