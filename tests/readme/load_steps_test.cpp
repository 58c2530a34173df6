// SPDX-License-Identifier: MIT
//
// Load steps, as README.md shows them; readme.cmake compares the two.
#include <slant/contact/dual.hpp>
#include <slant/contact/load_steps.hpp>
#include <slant/contact/preconditioners.hpp>
#include <slant/contact/primal_stepper.hpp>
#include <slant/factorizations/factorize.hpp>
#include <slant/methods/symmetric_newton.hpp>

#include <doctest/doctest.h>

#include <fem/steel_brick.hpp>
#include <ranges>

namespace contact = slant::contact;

TEST_CASE("the same without factors") {
  auto const brick = fem::make_steel_brick({.k = 2});
  auto const& K = brick.K;
  contact::data<double> const data{brick.N, brick.T, brick.f, brick.d, brick.g};
  auto const layout = contact::layout_of(brick.mesh.nodes, brick.unknowns.first);

  contact::primal_stepper stepper(K, data, {.tolerance = 1e-8, .layout = layout});
  Eigen::VectorXd w = Eigen::VectorXd::Zero(data.T.rows());
  for (int i = 1; i <= 20; ++i) {
    auto const& step = stepper.advance({.f = i / 20.0 * data.f, .w = w});  // also .d, .g
    if (!step.converged()) FAIL("step ", i, ": ", step.reason);
    w = data.T * step.u;  // friction resists what comes after this
  }
  CHECK(w.norm() > 0);
}

TEST_CASE("the load grows in twenty steps") {
  auto const brick = fem::make_steel_brick({.k = 1});
  auto const& K = brick.K;
  contact::data<double> const data{brick.N, brick.T, brick.f, brick.d, brick.g};
  Eigen::VectorXd u;

  contact::dual problem(contact::friction_disc{}, slant::factorize(K), data);
  auto const M = contact::lumped_preconditioner(K, problem.constraints());
  auto const method = slant::symmetric_newton{problem.qp(), M};
  auto const stop = slant::reduced_gradient_below(1e-9) || slant::at_most(100);
  auto const path = std::views::iota(1, 21) | std::views::transform([&](int i) {
                      return contact::load_step<>{.f = i / 20.0 * data.f};  // also .d, .g, .w
                    });
  for (auto const& step : contact::load_steps(problem, method, stop, path)) {
    if (!step.converged()) FAIL("step ", step.number, ": ", step.reason);  // it is the last one
    u = problem.displacement(step.x());
  }

  CHECK(problem.b().norm() > 0);
  contact::dual const whole(contact::friction_disc{}, slant::factorize(K), data);
  auto const cold = slant::solve(slant::symmetric_newton{whole.qp(), M}, whole.zero(), stop);
  CHECK((whole.displacement(cold.x()) - u).norm() <= 1e-6 * u.norm());
}
