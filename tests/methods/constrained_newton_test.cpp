// SPDX-License-Identifier: MIT
#include "equality_scenes.hpp"

#include <slant/methods/constrained_newton.hpp>

#include <doctest/doctest.h>

#include <support/allocation_guard.hpp>

#include <array>
#include <cmath>

namespace constrained_newton_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using slant::constrained_newton_step;
using slant::status;
using test::accurate;
using test::known_problem;
using test::sparse;

TEST_CASE("the known solution with its multipliers, in any units and lengths") {
  for (auto const& [unit, length] :
       {std::array{1.0, 1.0}, std::array{1e150, 1.0}, std::array{1e-150, 1.0},
        std::array{1.0, 1e150}, std::array{1.0, 1e-150}}) {
    CAPTURE(unit);
    CAPTURE(length);
    known_problem const p(unit, known_problem::n, length);
    auto const qp = p.qp();
    auto const constraints = p.constraints();
    slant::constrained_newton const method{qp, constraints};
    auto const r = test::check_solution(method, p);
    CHECK(r.iterations() <= 12);
    CHECK(r.state.fallback_count == 0);
    // r from the start and from each x; the coarse part of a step where x is off the space.
    auto const& work = r.state.work;
    CHECK(work.operator_applications >= work.inner_iterations + r.iterations());
    CHECK(work.operator_applications <= work.inner_iterations + 2 * r.iterations() + 2);
  }
}

TEST_CASE("a wedge that is met at a small angle takes no more steps than a wide one") {
  for (double const θ : {0.3, 0.05, 1e-2, 1e-4}) {
    CAPTURE(θ);
    test::wedge const w(θ);
    auto const qp = w.qp();
    auto const r = slant::solve(slant::constrained_newton{qp, w.constraints},
                                VectorXd(VectorXd::Zero(2)), accurate(1e-10));
    CAPTURE(r.reason);
    CHECK(r.converged());
    CHECK(!r.state.infeasible);
    CHECK((r.x() - VectorXd{{1.0, 0.0}}).norm() <= 1e-8);
    CHECK(r.iterations() <= 12);
  }
}

TEST_CASE("a preconditioner leads to the same solution in fewer products") {
  known_problem p;
  VectorXd const spread =
      VectorXd::LinSpaced(p.n, 0, 4).unaryExpr([](double t) { return std::pow(10.0, t); });
  VectorXd const rest = p.b - p.A * p.x;
  p.A += MatrixXd(spread.asDiagonal());
  p.b = rest + p.A * p.x;
  VectorXd const inverse = p.A.diagonal().cwiseInverse();
  auto const qp = p.qp();
  auto const constraints = p.constraints();
  auto const plain = test::check_solution(slant::constrained_newton{qp, constraints}, p);
  auto const M = slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(
      MatrixXd(inverse.asDiagonal()));
  auto const jacobi = test::check_solution(slant::constrained_newton{qp, constraints, M}, p);
  CHECK(2 * jacobi.state.work.inner_iterations <= plain.state.work.inner_iterations);
  CHECK_THROWS_AS((slant::constrained_newton{qp, constraints, slant::identity(3)}),
                  slant::bad_input);
}

TEST_CASE("as many equations as unknowns: the point that they leave") {
  MatrixXd const root = test::random_matrix(4, 4, 5), A = root * root.transpose();
  MatrixXd const G = test::random_matrix(4, 4, 7);
  VectorXd const b = test::random_matrix(4, 1, 6), x{{1.0, 2.0, 0.5, 3.0}}, e = G * x;
  slant::equality_constraints const constraints(sparse(G.sparseView()), e);
  auto const set =
      slant::cartesian(slant::free_components(4), slant::half_lines(0), slant::discs(VectorXd()));
  slant::separable_qp const qp{slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(A),
                               b, set};
  auto const r = slant::solve(slant::constrained_newton{qp, constraints},
                              VectorXd(VectorXd::Zero(4)), accurate(1e-12));
  CHECK(r.converged());
  CHECK((r.x() - x).norm() <= 1e-12);
}

TEST_CASE("constraints that no point satisfies are named") {
  known_problem p;
  p.G.row(0).setZero();
  p.G(0, 4) = p.G(0, 5) = 1;  // x_4 + x_5 = −1, both in half lines
  p.e[0] = -1;
  auto const qp = p.qp();
  auto const constraints = p.constraints();
  auto const r = slant::solve(slant::constrained_newton{qp, constraints},
                              VectorXd(VectorXd::Zero(p.n)), accurate(1e-10));
  CHECK(r.status == status::stalled);
  CHECK(r.state.infeasible);
  CHECK(r.state.fallback_count >= 1);
  CHECK(r.reason == "no point of the set satisfies the equality constraints");
}

TEST_CASE("where the face has lost what an equation depends on, SMALSE-M finds another one") {
  known_problem p;
  p.G = MatrixXd::Zero(1, p.n);
  p.G(0, 4) = p.G(0, 6) = 1;  // both at their bounds for ν = 0, and x = 0 there
  p.e = VectorXd::Ones(1);
  p.b[4] = -100;
  p.b[6] = -50;
  p.A.row(4) = p.A.row(6) = VectorXd::Zero(p.n);
  p.A.col(4) = p.A.col(6) = VectorXd::Zero(p.n);
  p.A(4, 4) = p.A(6, 6) = 1;
  auto const qp = p.qp();
  auto const constraints = p.constraints();
  auto const r = slant::solve(slant::constrained_newton{qp, constraints},
                              VectorXd(VectorXd::Zero(p.n)), accurate(1e-10));
  CAPTURE(r.reason);
  CHECK(r.converged());
  CHECK(r.state.fallback_count >= 1);
  CHECK(r.x()[4] == 0.0);
  CHECK(r.x()[6] == doctest::Approx(1.0));
}

TEST_CASE("a load that a bound absorbs does not spoil the accuracy") {
  known_problem p;
  p.b[4] -= 1e6;
  p.b[6] -= 1e5;
  auto const qp = p.qp();
  auto const constraints = p.constraints();
  auto const r = slant::solve(slant::constrained_newton{qp, constraints},
                              VectorXd(VectorXd::Zero(p.n)), accurate(1e-10));
  CAPTURE(r.reason);
  CHECK(r.converged());
  CHECK((r.x() - p.x).norm() <= 1e-8);
}

TEST_CASE("a step does not allocate, before and after the fallback has been at work") {
  known_problem const p;
  auto const qp = p.qp();
  auto const constraints = p.constraints();
  slant::constrained_newton const method{qp, constraints};
  auto state = method.start(VectorXd::Constant(p.n, -3.0));
  CHECK(qp.set().contains(state.x));
  slant::testing::allocation_guard guard;
  method.step(state);
  method.step(state);
  auto const allocations = guard.count();
  CHECK(allocations == 0);
  CHECK(state.last_step != constrained_newton_step::fallback);
}

TEST_CASE("bad input") {
  known_problem const p;
  auto const qp = p.qp();
  auto const constraints = p.constraints();
  slant::equality_constraints const other(sparse(1, 3), VectorXd(VectorXd::Zero(1)));
  CHECK_THROWS_AS((slant::constrained_newton{qp, other}), slant::bad_input);
  slant::constrained_newton const method{qp, constraints};
  CHECK_THROWS_AS(static_cast<void>(method.start(VectorXd::Zero(3))), slant::bad_input);
  using options = slant::constrained_newton_options<double>;
  for (options const& o :
       {options{.step_factor = 0}, options{.inner_steps = 0}, options{.sufficient = 1},
        options{.halvings = -1}, options{.patience = -1}, options{.fallback = {.penalty = 0}}}) {
    CHECK_THROWS_AS((slant::constrained_newton{qp, constraints, o}), slant::bad_input);
  }
}

}  // namespace constrained_newton_test
