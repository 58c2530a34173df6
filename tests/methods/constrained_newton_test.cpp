// SPDX-License-Identifier: MIT
#include <slant/methods/constrained_newton.hpp>

#include <certificates/made_programs.hpp>
#include <support/testing.hpp>
#include "equality_scenes.hpp"

namespace constrained_newton_test {

using test::accurate;
using test::known_problem;

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
    auto const r =
        slant::solve(slant::constrained_newton{qp, w.constraints}, test::zeros(2), accurate(1e-10));
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
  auto const r =
      slant::solve(slant::constrained_newton{qp, constraints}, test::zeros(p.n), accurate(1e-10));
  CAPTURE(r.reason);
  CHECK(r.converged());
  CHECK(r.state.fallback_count >= 1);
  CHECK(r.x()[4] == 0.0);
  CHECK(r.x()[6] == doctest::Approx(1.0));
}

TEST_CASE("equations that agree on the face, where they are one: Newton's step, at any angle") {
  VectorXd const b{{10.0, 0.0, 0.0}};
  MatrixXd const A = MatrixXd::Identity(3, 3);
  auto const set = slant::half_lines(3);
  slant::separable_qp const qp{slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(A),
                               b, set};
  for (double const θ : {0.3, 1e-2, 1e-4}) {
    CAPTURE(θ);
    double const s = std::sin(θ), c = std::cos(θ);
    MatrixXd const G{{s, c, 0.0}, {s, 0.0, c}};  // the same for x₁ = x₂ = 0
    slant::equality_constraints const constraints(sparse(G.sparseView()), VectorXd{{s, s}});
    auto const r =
        slant::solve(slant::constrained_newton{qp, constraints}, test::zeros(3), accurate(1e-10));
    CHECK(r.converged());
    CHECK((r.x() - VectorXd{{1.0, 0.0, 0.0}}).norm() <= 1e-9);
    CHECK(r.iterations() <= 4);
    CHECK(r.state.fallback_count == 0);
  }
}

TEST_CASE("a multiplier that is far away in units of the fallback's penalty is found") {
  for (unsigned const seed : {8U, 47U, 54U, 60U, 67U}) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    auto const p = test::make_program(2, 1, random);
    MatrixXd const G = test::random_matrix(4, 6, seed);
    VectorXd const b = p.b + G.transpose() * test::random_matrix(4, 1, seed + 1000);
    slant::separable_qp const qp{
        slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(p.A), b,
        slant::cartesian(slant::free_components(0), slant::half_lines(2), slant::discs(p.g))};
    slant::equality_constraints const constraints(sparse(G.sparseView()), VectorXd(G * p.solution));
    auto const r =
        slant::solve(slant::constrained_newton{qp, constraints}, test::zeros(6), accurate(1e-9));
    CAPTURE(r.reason);
    CHECK(r.converged());
    CHECK(r.state.penalty_factor > 1);
    CHECK((r.x() - p.solution).norm() <= 1e-7 * p.solution.norm());
  }
}

}  // namespace constrained_newton_test
