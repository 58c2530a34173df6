// SPDX-License-Identifier: MIT
#include <slant/contact/coulomb/coulomb.hpp>

#include "coulomb_scenes.hpp"
#include "counting_factor.hpp"

#include <slant/contact/load_stepper.hpp>
#include <slant/contact/preconditioners.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <support/testing.hpp>

namespace coulomb_test {

auto stop(double tolerance) {
  return slant::reduced_gradient_below(tolerance) || slant::at_most(200);
}

TEST_CASE("pressed, dragged and released: each step obeys the law for its increment of slip") {
  auto const press = fem::make_steel_brick({.k = 2});
  auto const lift = fem::make_steel_brick({.k = 2, .load = fem::brick_load::lift});
  auto c = test::contact_data(press);
  c.f.setZero();
  test::counting_factor factor{press.K};
  contact::dual problem(contact::friction_disc{}, factor, c);
  Eigen::Index const m = c.d.size();
  VectorXd const F = VectorXd::Constant(m, 0.3);
  contact::coulomb_radii family(problem, contact::coefficients(F));
  auto const M = contact::lumped_preconditioner(press.K, problem.constraints());
  contact::load_stepper stepper(family, contact::coulomb(family, M, {.goal = 1e-11}), stop(1e-11));

  VectorXd position = VectorXd::Zero(2 * m);
  double largest = 0, released = 0;
  slant::index number = 0, first = 0;
  for (double const time : {0.5, 1.0, 1.5, 2.0, 2.5, 3.0}) {
    CAPTURE(time);
    double const p = time <= 2 ? std::min(time, 1.0) : 3 - time;
    double const d = time <= 1 ? 0 : time <= 2 ? time - 1 : 3 - time;
    c.f = p * press.f + d * (lift.f - press.f);
    auto const& step = stepper.advance({.f = c.f, .w = position});
    CHECK(step.number == ++number);
    REQUIRE(step.converged());
    // The second step is in proportion to the first, which is seen before it is solved.
    if (number == 1) first = step.work.operator_applications;
    if (number == 2) CHECK(step.work.operator_applications < first);
    CHECK((number == 1) == (step.work.setup_applications > 0));
    test::dense_dual dense(press.K, c);
    dense.b.tail(2 * m) -= position;
    if (c.f.norm() > 0) CHECK(test::natural_map(dense, F, step.x()) <= 1e-8);
    VectorXd const u = problem.displacement(step.x());
    // What the gradient says of the slip: r_t = −(T u − w).
    VectorXd const slip = dense.A * step.x() - dense.b;
    CHECK((slip.tail(2 * m) + (c.T * u - position)).norm() <= 1e-10 * dense.b.norm());
    position = c.T * u;
    if (time == 2) largest = position.norm();
    if (time == 2.5) released = position.norm();
  }
  CHECK(largest > 0);
  CHECK(released > 0);
}

TEST_CASE("no friction: the products of the frictionless problem, for both families") {
  auto const s = fem::make_steel_brick({.k = 2, .load = fem::brick_load::lift});
  auto c = test::contact_data(s);
  c.g.setZero();
  test::counting_factor const factor{s.K};
  contact::dual problem(contact::friction_disc{}, factor, c);
  VectorXd const none = VectorXd::Zero(c.d.size());
  slant::identity_operator const I(problem.b().size());
  contact::coulomb_options const o{.goal = 1e-9};
  slant::symmetric_newton_options<double> const newton{
      .forcing = {.γ = 0.9, .exponent = 1.5, .η_max = 0.1, .η_first = 0.1, .goal = o.goal}};
  auto const tresca =
      slant::solve(slant::symmetric_newton{problem.qp(), newton}, problem.zero(), stop(1e-9));
  contact::coulomb_radii radii(problem, contact::coefficients(none));
  contact::coulomb_cones cones(problem, none);
  auto const by_radii = slant::solve(contact::coulomb(radii, I, o), radii.zero(), stop(1e-9));
  auto const by_cones = slant::solve(contact::coulomb(cones, I, o), cones.zero(), stop(1e-9));
  REQUIRE(by_radii.converged());
  REQUIRE(by_cones.converged());
  CHECK(by_radii.x() == tresca.x());
  CHECK(by_radii.state.work == [&] {
    auto work = tresca.state.work;
    work.inner_iterations = by_radii.state.work.inner_iterations;  // of another kind
    return work;
  }());
  CHECK((cones.by_directions(by_cones.x()) - tresca.x()).norm() <= 1e-7 * tresca.x().norm());
  CHECK(by_cones.state.work.operator_applications <= tresca.state.work.operator_applications + 5);
}

TEST_CASE("new tangential positions: no solve, and data that do not fit are refused") {
  auto const s = fem::make_steel_brick({.k = 2});
  auto const c = test::contact_data(s);
  test::counting_factor const factor{s.K};
  contact::dual problem(contact::friction_disc{}, factor, c);
  auto const solves = factor.solves;
  VectorXd const b = problem.b(), w = VectorXd::LinSpaced(c.T.rows(), -1e-3, 2e-3);
  problem.update({.w = w});
  CHECK(factor.solves == solves);
  CHECK((problem.b().tail(w.size()) - (b.tail(w.size()) - w)).norm() <= 1e-15);
  CHECK(problem.b().head(c.d.size()) == b.head(c.d.size()));
  problem.update_load(2 * c.f);  // w stays
  CHECK((problem.b().tail(w.size()) - (2 * b.tail(w.size()) - w)).norm() <= 1e-15);
  VectorXd const before = problem.b();
  auto const message = [&](VectorXd const& bad) -> std::string {
    return SLANT_COMPLAINT(problem.update({.w = bad}));
  };
  CHECK(message(VectorXd::Zero(3)).starts_with("w: got 3, expected"));
  CHECK(message(VectorXd::Constant(w.size(), NAN)).starts_with("w[0]: got nan"));
  CHECK(problem.b() == before);
}

}  // namespace coulomb_test
