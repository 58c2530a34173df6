// SPDX-License-Identifier: MIT
//
// Load steps, as README.md shows them; readme.cmake compares the two.
#include <slant/contact/dual.hpp>
#include <slant/contact/load_steps.hpp>
#include <slant/contact/preconditioners.hpp>
#include <slant/factorizations/factorize.hpp>
#include <slant/methods/symmetric_newton.hpp>

#include <doctest/doctest.h>

#include <fem/steel_brick.hpp>
#include <ranges>

namespace contact = slant::contact;

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
                      return contact::load_step<>{.f = i / 20.0 * data.f};  // also .d, .g
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
