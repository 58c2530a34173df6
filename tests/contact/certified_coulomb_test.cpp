// SPDX-License-Identifier: MIT
#include <slant/contact/certified_coulomb.hpp>

#include <slant/contact/optimality.hpp>
#include <slant/contact/primal_stepper.hpp>

#include <fem/two_bricks.hpp>
#include <support/testing.hpp>
#include "coulomb_scenes.hpp"
#include "counting_factor.hpp"
#include "spring_scenes.hpp"

namespace certified_coulomb_test {

using slant::status;

constexpr contact::coulomb_method methods[] = {
    contact::coulomb_method::automatic, contact::coulomb_method::newton,
    contact::coulomb_method::radii, contact::coulomb_method::cones};

auto solve(Eigen::SparseMatrix<double> const& K, contact::data<double> const& c, VectorXd const& F,
           contact::certified_coulomb_options<double> const& o = {}) {
  return contact::certified_coulomb(contact::friction_disc{}, K, c, F, o);
}

/// The residual of Tresca's conditions with the bounds F λ_ν.
template <class Result>
double kkt(Eigen::SparseMatrix<double> const& K, contact::data<double> c, VectorXd const& F,
           Result const& r) {
  c.g = F.cwiseProduct(r.λ.head(F.size()).cwiseMax(0));
  return contact::check_optimality(K, c, r.u, r.λ).residual();
}

TEST_CASE("certified_coulomb: a brick by every method, the same solution") {
  auto const s = fem::make_steel_brick({.k = 2, .load = fem::brick_load::lift});
  auto const c = test::contact_data(s);
  VectorXd const F = VectorXd::Constant(c.nodes(), 0.3);
  VectorXd first;
  for (auto const method : methods) {
    CAPTURE(int(method));
    auto const r = solve(s.K, c, F, {.method = method});
    CAPTURE(r.reason);
    REQUIRE(r.converged());
    CHECK_FALSE(r.scaled);
    CHECK(r.error.relative() <= 1e-8);
    CHECK(kkt(s.K, c, F, r) <= 1e-7);
    CHECK(test::natural_map(test::dense_dual(s.K, c), F, r.λ) <= 1e-7);
    if (first.size() == 0) first = r.u;
    CHECK((r.u - first).norm() <= 1e-7 * first.norm());
  }
}

TEST_CASE("certified_coulomb: so much friction that Newton's method and radii fail now and then") {
  unsigned const problems = test::effort(4000U, 300U);
  int by_matrix = 0;
  for (unsigned seed = 0; seed < problems; ++seed) {
    CAPTURE(seed);
    std::mt19937_64 bits(seed);
    auto const fill = [&](auto&& numbers, double from, double to) {
      for (double& x : numbers) x = from + (to - from) * std::ldexp(double(bits() >> 11), -53);
    };
    MatrixXd Q(9, 9), I = MatrixXd::Identity(9, 9);
    VectorXd f(9), F(3);
    fill(Q.reshaped(), -1, 1);
    fill(f, -2, 2);
    fill(F, 0, 20);
    sparse const K = MatrixXd(Q * Q.transpose() + 0.3 * I).sparseView(), N = I.sparseView();
    contact::data<double> const c{N.topRows(3), N.bottomRows(6), f, VectorXd::Zero(3), {}};
    auto const r = solve(K, c, F);
    CAPTURE(r.reason);
    CHECK((r.converged() || r.u.norm() <= 1e-8));  // the latter where everything sticks, u* = 0
    if (r.method != "solve_friction") continue;
    ++by_matrix;
    CHECK(test::natural_map(test::dense_dual(K, c), F, r.λ) <= 1e-7);
  }
  CHECK((by_matrix > 0 && by_matrix < int(problems / 10)));
}

TEST_CASE("certified_coulomb: thin, slender and nearly floating bodies, no wrong verdict" *
          doctest::skip(!test::is_optimised)) {
  auto const judge = [](Eigen::SparseMatrix<double> const& K, contact::data<double> const& c,
                        int at_least) {
    VectorXd const F = VectorXd::Constant(c.nodes(), 0.3);
    int solved = 0;
    for (auto const method : methods) {
      CAPTURE(int(method));
      auto const r = solve(K, c, F, {.method = method});
      CAPTURE(r.reason);
      CHECK(r.condition > 1e4);
      solved += r.converged();
      if (r.converged()) {
        CHECK(kkt(K, c, F, r) <= 1e-7);
        CHECK(r.reason.ends_with(", at most 1e-08"));
      } else {
        CHECK((r.status == status::stalled || r.status == status::iteration_limit));
        CHECK(r.error.relative() > 1e-8);
        CHECK(r.reason.find("condition of K about") != std::string::npos);
      }
    }
    CHECK(solved >= at_least);
  };
  auto const brick = [](double length, double height) {
    return fem::make_steel_brick(
        {.k = 1, .load = fem::brick_load::lift, .size = Vector3d(length, 1, height)});
  };
  auto const slender = brick(300, 1), thin = brick(3, 1e-4);
  judge(slender.K, test::contact_data(slender), 3);  // Newton's alone finds no way
  judge(thin.K, test::contact_data(thin), 0);
  auto const loose = test::spring_block<3>(2, 1e-4);
  judge(loose.K, loose.contact, 2);
}

TEST_CASE("certified_coulomb: rows of a contact in any units, the cone unchanged") {
  auto const s = fem::make_steel_brick({.k = 2, .load = fem::brick_load::lift});
  auto const given = test::contact_data(s);
  VectorXd const F = VectorXd::Constant(given.nodes(), 0.3);
  auto const reference = solve(s.K, given, F);
  REQUIRE(reference.converged());
  auto c = given;
  std::mt19937 random(1);
  std::uniform_int_distribution<int> exponent(-25, 25);
  VectorXd rows(c.nodes()), pairs(2 * c.nodes());
  for (slant::index i = 0; i < c.nodes(); ++i) {
    rows(i) = std::ldexp(1.0, exponent(random));
    pairs.segment<2>(2 * i).setConstant(rows(i));
    c.d(i) *= rows(i);
  }
  c.N = Eigen::SparseMatrix<double>(rows.asDiagonal() * given.N);
  c.T = Eigen::SparseMatrix<double>(pairs.asDiagonal() * given.T);
  for (auto const method : {contact::coulomb_method::newton, contact::coulomb_method::radii}) {
    auto const r = solve(s.K, c, F, {.method = method});
    CAPTURE(r.reason);
    CHECK(r.scaled);
    CHECK((r.u - reference.u).norm() <= 1e-6 * reference.u.norm());
    VectorXd const λ = r.λ.head(F.size()).cwiseProduct(rows);
    CHECK((λ - reference.λ.head(F.size())).norm() <= 1e-6 * reference.λ.norm());
    auto const unscaled = solve(s.K, c, F, {.method = method, .scale = false});
    CHECK_FALSE(unscaled.scaled);
    CHECK(unscaled.work.operator_applications > 2 * r.work.operator_applications);
    if (unscaled.converged()) CHECK((unscaled.u - reference.u).norm() <= 1e-6 * reference.u.norm());
  }
  // Rows of N and T apart, beyond where their squares are numbers: F is in units of both.
  VectorXd other = F;
  for (slant::index i = 0; i < c.nodes(); ++i) {
    double const n = i % 2 == 0 ? 0x1p450 : 0x1p-515;
    other(i) *= n / 0x1p515;
    c.d(i) = given.d(i) * n;
    rows(i) = n;
  }
  c.N = Eigen::SparseMatrix<double>(rows.asDiagonal() * given.N);
  c.T = 0x1p515 * given.T;
  auto const far = solve(s.K, c, other);
  CHECK(far.converged());
  CHECK((far.u - reference.u).norm() <= 1e-6 * reference.u.norm());
  CHECK(solve(s.K, c, VectorXd::Zero(F.size())).converged());
}

TEST_CASE("certified_coulomb: any units of stiffness and load") {
  auto const s = fem::make_steel_brick({.k = 1, .load = fem::brick_load::lift});
  auto const given = test::contact_data(s);
  VectorXd const F = VectorXd::Constant(given.nodes(), 0.3);
  auto const reference = solve(s.K, given, F);
  REQUIRE(reference.converged());
  for (auto const& [stiffness, load] :
       {std::pair{0, 480}, {0, -480}, {300, -100}, {-300, 100}, {480, 480}, {-480, -480}}) {
    CAPTURE(stiffness);
    CAPTURE(load);
    auto c = given;
    c.f *= std::ldexp(1.0, load);
    c.d *= std::ldexp(1.0, load - stiffness);
    auto const r = solve(Eigen::SparseMatrix<double>(std::ldexp(1.0, stiffness) * s.K), c, F);
    CAPTURE(r.reason);
    CHECK(r.converged());
    VectorXd const u = std::ldexp(1.0, stiffness - load) * r.u;
    CHECK((u - reference.u).norm() <= 1e-7 * reference.u.norm());
  }
}

TEST_CASE("certified_coulomb: options and coefficients that do not fit are refused") {
  auto const s = fem::make_steel_brick({.k = 1});
  auto const c = test::contact_data(s);
  VectorXd const F = VectorXd::Constant(c.nodes(), 0.3);
  auto const message =
      [&](VectorXd const& coefficients,
          contact::certified_coulomb_options<double> const& o = {}) -> std::string {
    return SLANT_COMPLAINT(solve(s.K, c, coefficients, o));
  };
  CHECK(message(-F) == "F[0]: got -0.3, expected a finite number >= 0");
  CHECK(message(F.head(2)) ==
        "number of friction coefficients: got 2, expected one per contact node, 6");
  CHECK(message(F, {.tolerance = 1}).starts_with("tolerance: got 1"));
  CHECK(message(F, {.newton_steps = 0}) == "newton_steps: got 0, expected at least 1");
  CHECK(message(F, {.outer_steps = 0}) == "outer_steps: got 0, expected at least 1");
  auto frictionless = c;
  frictionless.T.resize(0, c.T.cols());
  CHECK(SLANT_COMPLAINT(solve(s.K, frictionless, F, {})) ==
        "rows of T: got 0, expected 6 (2D) or 12 (3D)");
  CHECK(SLANT_COMPLAINT(contact::primal_coulomb_stepper(s.K, frictionless, F)) ==
        "rows of T: got 0, expected 6 (2D) or 12 (3D)");
}

TEST_CASE("certified_coulomb: a body without supports is refused by the name of its motions") {
  auto const s = test::spring_block<2>(2, 0);
  VectorXd const F = VectorXd::Constant(s.contact.nodes(), 0.3);
  std::string const said =
      SLANT_COMPLAINT(contact::certified_coulomb(contact::friction_line{}, s.K, s.contact, F));
  CHECK(said.find("body 0 (unknowns 0 to 29) has 3 free motions") != said.npos);
}

template <class Dual>
auto solve(Dual& problem, VectorXd const& F, contact::detail::coulomb_limits const& limits) {
  contact::coulomb_check const check(problem, F);
  return contact::detail::solve_by_all_methods(
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
    Vector2d const t = z.segment<2>(m + 2 * i);
    double const bound = μ(i) * n;
    r(i) -= n;
    r.segment<2>(m + 2 * i) -= t.norm() > bound ? Vector2d(bound / t.norm() * t) : t;
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
    auto r = solve(problem, F,
                   {.tolerance = 1e-12, .newton_steps = newton, .outer_steps = outer, .forces = 0});
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
    double const residual = kkt(s.K, s.contact, F, r);
    CHECK(r.error == r.law.relative);
    CHECK(r.law.largest <= r.law.relative);
    CHECK(r.law.contact >= 0);
    CHECK(residual <=
          2 * r.error + 1e-13 / spring);  // of all nodes here, of two kinds of residual there
    CHECK(r.error <= 4 * residual + 1e-13 / spring);
    if (!r.converged()) {
      if (r.status == slant::status::stalled) CHECK(!r.reason.empty());
      continue;
    }
    CHECK(residual <= 200 * tolerance);
    if (++converged == 1) found = r.λ;
    CHECK((r.λ - found).norm() <= 1e4 * tolerance * found.norm());
  }
  return converged;
}

TEST_CASE("a block that hardly anything holds: forces right to 1e-6, or no verdict of success" *
          doctest::skip(!test::is_optimised)) {
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
  auto const r = contact::detail::solve_by_all_methods(
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
  auto const none = contact::detail::solve_by_all_methods(
      problem, F, {},
      [](VectorXd const&, VectorXd const&) { return std::numeric_limits<double>::quiet_NaN(); });
  CHECK(none.status == slant::status::stalled);
}

}  // namespace certified_coulomb_test
