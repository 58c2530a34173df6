// SPDX-License-Identifier: MIT
//
// The methods of certified_coulomb and how they take turns, judged by Coulomb's law alone: the work
// that is said to have been done is counted, without that of a certificate.
#include <slant/contact/certified_coulomb.hpp>

#include "coulomb_scenes.hpp"
#include "counting_factor.hpp"
#include "spring_scenes.hpp"

#include <slant/contact/optimality.hpp>

#include <fem/two_bricks.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace coulomb_run_test {

using Eigen::VectorXd;
namespace contact = slant::contact;

template <class Dual>
auto solve(Dual& problem, VectorXd const& F, contact::detail::coulomb_limits const& limits) {
  contact::coulomb_check const check(problem, F);
  return contact::detail::solve_by_newton_or_radii(
      problem, F, limits,
      [&](VectorXd const& λ, VectorXd const& u) { return check(λ, u).relative; });
}

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
    auto const newton = solve(problem, F, {.tolerance = 1e-12});
    REQUIRE(newton.converged());
    CHECK(newton.method == "Newton");
    CHECK(test::natural_map(dense, F, newton.λ) <= 1e-8);
    CHECK(factor.solves == newton.work.operator_applications + newton.work.setup_applications);
    auto const radii = solve(problem, F, {.tolerance = 1e-12, .newton_steps = 0});
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
  auto const r = solve(problem, F, {.tolerance = 1e-10, .newton_steps = 1});
  REQUIRE(r.converged());
  CHECK(r.method == "successive approximations");
  CHECK(factor.solves == r.work.operator_applications + r.work.setup_applications);
  CHECK(test::natural_map(test::dense_dual(s.K, c), F, r.λ) <= 1e-8);
  auto const given_up =
      solve(problem, F, {.tolerance = 1e-10, .newton_steps = 1, .outer_steps = 0});
  CHECK(given_up.status == slant::status::iteration_limit);
  CHECK(given_up.method == "Newton");
  CHECK(given_up.steps == 1);
}

/// ‖λ − P(λ − ρ (A λ − b))‖, P that of Alart and Curnier.
double alart_curnier_residual(test::dense_dual const& p, VectorXd const& μ, VectorXd const& λ,
                              double ρ) {
  Eigen::Index const m = μ.size();
  VectorXd const z = λ - ρ * (p.A * λ - p.b);
  VectorXd r = λ;
  for (Eigen::Index i = 0; i < m; ++i) {
    double const n = std::max(0.0, z(i));
    Eigen::Vector2d const t = z.segment<2>(m + 2 * i);
    double const bound = μ(i) * n;
    r(i) -= n;
    r.segment<2>(m + 2 * i) -= t.norm() > bound ? Eigen::Vector2d(bound / t.norm() * t) : t;
  }
  return r.norm();
}

TEST_CASE("neither is given time: the better answer is kept, whichever it is") {
  auto const s = fem::make_steel_brick({.k = 2, .load = fem::brick_load::lift});
  auto const c = test::contact_data(s);
  test::counting_factor const factor{s.K};
  contact::dual problem(contact::friction_disc{}, factor, c);
  test::dense_dual const dense(s.K, c);
  VectorXd const F = VectorXd::Constant(c.d.size(), 0.3);
  double const ρ = contact::residual_step(contact::coulomb_cones(problem, F)).length;
  auto const run = [&](slant::index newton, slant::index outer) {
    factor.solves = 0;
    auto r = solve(problem, F, {.tolerance = 1e-12, .newton_steps = newton, .outer_steps = outer});
    CHECK_FALSE(r.converged());
    CHECK(factor.solves == r.work.operator_applications + r.work.setup_applications);
    return r;
  };
  slant::index newton_wins = 0, approximations_win = 0;
  for (auto const& [newton_steps, outer_steps] :
       {std::pair<slant::index, slant::index>{1, 3}, {4, 1}}) {
    CAPTURE(newton_steps);
    auto const newton = run(newton_steps, 0), outer = run(0, outer_steps);
    double const by_newton = alart_curnier_residual(dense, F, newton.λ, ρ);
    double const by_outer = alart_curnier_residual(dense, F, outer.λ, ρ);
    CAPTURE(by_newton);
    CAPTURE(by_outer);
    auto const& better = by_newton <= by_outer ? newton : outer;
    ++(by_newton <= by_outer ? newton_wins : approximations_win);
    auto const both = run(newton_steps, outer_steps);
    CHECK(both.λ == better.λ);
    CHECK(both.method == better.method);
    CHECK(both.steps == better.steps);
    CHECK(both.status == better.status);
    CHECK(both.reason == better.reason);
  }
  CHECK(newton_wins == 1);
  CHECK(approximations_win == 1);
}

/// A block on springs, by Newton's method and by radii; each verdict beside check_optimality. How
/// many converged.
template <int D, class Friction>
int judge_on_springs(Friction friction, double spring, double tolerance) {
  CAPTURE(D);
  CAPTURE(spring);
  auto const s = test::spring_block<D>(3, spring);
  test::counting_factor const factor{s.K};
  contact::dual problem(friction, factor, s.contact);
  VectorXd const F = VectorXd::Constant(s.contact.d.size(), 0.3);
  int converged = 0;
  VectorXd found;
  for (slant::index const newton_steps : {60, 0}) {
    factor.solves = 0;
    auto const r = solve(problem, F, {.tolerance = tolerance, .newton_steps = newton_steps});
    CHECK(factor.solves == r.work.operator_applications + r.work.setup_applications);
    auto law = s.contact;
    law.g = F.cwiseProduct(r.λ.head(F.size()).cwiseMax(0));
    double const kkt = contact::check_optimality(s.K, law, r.u, r.λ).residual();
    CHECK(r.error == r.law.relative);
    CHECK(r.law.largest <= r.law.relative);
    CHECK(r.law.contact >= 0);
    CHECK(kkt <=
          2 * r.error + 1e-13 / spring);  // of all nodes here, of two kinds of residual there
    CHECK(r.error <= 4 * kkt + 1e-13 / spring);
    if (!r.converged()) {
      if (r.status == slant::status::stalled) CHECK(!r.reason.empty());
      continue;
    }
    CHECK(kkt <= 200 * tolerance);
    if (++converged == 1) found = r.λ;
    CHECK((r.λ - found).norm() <= 1e4 * tolerance * found.norm());
  }
  return converged;
}

TEST_CASE("a block that hardly anything holds: forces right to 1e-6, or no verdict of success") {
  using line = contact::friction_line;
  CHECK(judge_on_springs<2>(line{}, 1e-2, 1e-10) == 2);
  CHECK(judge_on_springs<2>(line{}, 1e-4, 1e-10) == 2);
  CHECK(judge_on_springs<2>(line{}, 1e-6, 1e-10) == 2);
  // Here rounding of A λ − b alone is more than is asked for.
  CHECK(judge_on_springs<2>(line{}, 1e-10, 1e-10) == 0);
  CHECK(judge_on_springs<2>(line{}, 1e-12, 1e-10) == 0);
  // Asked for less they do: b = 4e8 of the load times the compliance.
  CHECK(judge_on_springs<2>(line{}, 1e-8, 1e-8) == 2);
  CHECK(judge_on_springs<3>(contact::friction_disc{}, 1e-4, 1e-10) == 2);
}

TEST_CASE("a check that nothing satisfies: the run stalls and says what it finds") {
  auto const s = test::spring_block<2>(2, 1e-2);
  test::counting_factor const factor{s.K};
  contact::dual problem(contact::friction_line{}, factor, s.contact);
  VectorXd const F = VectorXd::Constant(s.contact.d.size(), 0.3);
  int asked = 0;
  auto const r = contact::detail::solve_by_newton_or_radii(
      problem, F, {}, [&](VectorXd const& λ, VectorXd const& u) {
        ++asked;
        CHECK((u - problem.displacement(λ)).norm() == 0);
        return 0.5;
      });
  CHECK(r.status == slant::status::stalled);
  CHECK(r.error == 0.5);
  CHECK(r.law.relative <= 1e-8);
  CHECK(r.reason.starts_with("the check finds 0.5, more than 1e-08, largest at contact "));
  CHECK(asked >= 2);
  auto const none = contact::detail::solve_by_newton_or_radii(
      problem, F, {},
      [](VectorXd const&, VectorXd const&) { return std::numeric_limits<double>::quiet_NaN(); });
  CHECK(none.status == slant::status::stalled);
}

}  // namespace coulomb_run_test
