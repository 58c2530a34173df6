// SPDX-License-Identifier: MIT
#include <slant/contact/solve_coulomb.hpp>

#include "coulomb_scenes.hpp"
#include "counting_factor.hpp"

#include <fem/two_bricks.hpp>

#include <doctest/doctest.h>

#include <string>

namespace solve_coulomb_test {

using Eigen::VectorXd;
namespace contact = slant::contact;

TEST_CASE("two bricks, friction coefficients 0 to 2 on the mean: by Newton and by radii") {
  auto const s = fem::make_two_bricks(4);
  contact::data<double> const c{s.N, s.T, s.f, s.d, s.g};
  test::counting_factor const factor{s.K};
  test::dense_dual const dense(s.K, c);
  contact::dual problem(contact::friction_disc{}, factor, c);
  for (double const mean : {0.0, 0.3, 1.0, 2.0}) {
    CAPTURE(mean);
    VectorXd const F = mean * VectorXd::LinSpaced(c.d.size(), 0.5, 1.5);
    factor.solves = 0;
    auto const newton = contact::solve_coulomb(problem, F, {.tolerance = 1e-12});
    REQUIRE(newton.converged());
    CHECK(newton.method == "Newton");
    CHECK(test::natural_map(dense, F, newton.λ) <= 1e-8);
    CHECK(factor.solves == newton.work.operator_applications + newton.work.setup_applications);
    auto const radii = contact::solve_coulomb(problem, F, {.tolerance = 1e-12, .newton_steps = 0});
    REQUIRE(radii.converged());
    CHECK(radii.method == "successive approximations");
    CHECK((radii.λ - newton.λ).norm() <= 1e-8 * newton.λ.norm());
  }
}

TEST_CASE("Newton's method that is not given time: the other takes over, and all is counted") {
  auto const s = fem::make_steel_brick({.k = 2, .load = fem::brick_load::lift});
  auto const c = test::contact_data(s);
  test::counting_factor const factor{s.K};
  contact::dual problem(contact::friction_disc{}, factor, c);
  VectorXd const F = VectorXd::Constant(c.d.size(), 0.3);
  factor.solves = 0;
  auto const r = contact::solve_coulomb(problem, F, {.tolerance = 1e-10, .newton_steps = 1});
  REQUIRE(r.converged());
  CHECK(r.method == "successive approximations");
  CHECK(factor.solves == r.work.operator_applications + r.work.setup_applications);
  CHECK(test::natural_map(test::dense_dual(s.K, c), F, r.λ) <= 1e-8);
  auto const given_up =
      contact::solve_coulomb(problem, F, {.tolerance = 1e-10, .newton_steps = 1, .outer_steps = 0});
  CHECK(given_up.status == slant::status::iteration_limit);
  CHECK(given_up.method == "Newton");
  CHECK(given_up.steps == 1);
}

TEST_CASE("options and coefficients that do not fit are refused") {
  auto const s = fem::make_steel_brick({.k = 1});
  auto const c = test::contact_data(s);
  test::counting_factor const factor{s.K};
  contact::dual problem(contact::friction_disc{}, factor, c);
  auto const message = [&](VectorXd const& F,
                           contact::solve_coulomb_options const& o = {}) -> std::string {
    try {
      static_cast<void>(contact::solve_coulomb(problem, F, o));
    } catch (slant::bad_input const& e) {
      return e.what();
    }
    return "accepted";
  };
  VectorXd const F = VectorXd::Constant(c.d.size(), 0.3);
  CHECK(message(-F) == "F[0]: got -0.3, expected a finite number >= 0");
  CHECK(message(F.head(2)).starts_with("number of friction coefficients: got 2"));
  CHECK(message(F, {.tolerance = 0}) == "tolerance: got 0, expected a number in (0, 1)");
  CHECK(message(F, {.newton_steps = -1}) == "newton_steps: got -1, expected a number >= 0");
  CHECK(message(F, {.outer_steps = -1}) == "outer_steps: got -1, expected a number >= 0");
}

}  // namespace solve_coulomb_test
