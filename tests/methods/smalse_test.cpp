// SPDX-License-Identifier: MIT
#include <slant/methods/smalse.hpp>

#include <support/minimise.hpp>
#include <support/testing.hpp>
#include "equality_scenes.hpp"

namespace smalse_test {

using slant::status;
using test::accurate;
using test::known_problem;

TEST_CASE("the known solution with its multipliers, in any units and lengths") {
  for (auto const& [unit, length] :
       {std::array{1.0, 1.0}, std::array{1e150, 1.0}, std::array{1e-150, 1.0},
        std::array{1.0, 1e140}, std::array{1.0, 1e-158}}) {
    CAPTURE(unit);
    CAPTURE(length);
    known_problem const p(unit, known_problem::n, length);
    auto const qp = p.qp();
    auto const constraints = p.constraints();
    auto const r = test::check_solution(slant::smalse{qp, constraints}, p);
    CHECK(r.iterations() <= 30);
    auto const& work = r.state.work;
    CHECK(work.inner_iterations <= 300);
    // The bound of σ_max, A x̄, ‖A‖ and two multipliers; one product an outer step besides those of
    // KPRGP, and one more of it for a step that leaves the set.
    CHECK(work.setup_applications <= p.n + 4);
    CHECK(work.operator_applications >= work.inner_iterations + r.iterations() - 1);
    CHECK(work.operator_applications <= 2 * work.inner_iterations + r.iterations());
  }
}

TEST_CASE("semidefinite A, redundant rows") {
  known_problem const p(1, 21);
  auto const qp = p.qp();
  MatrixXd rows(7, p.n);
  rows << p.G, 1e3 * p.G.row(1) - p.G.row(4), p.G.row(0);
  VectorXd e(7);
  e << p.e, 1e3 * p.e[1] - p.e[4], p.e[0];
  slant::equality_constraints const constraints(sparse(rows.sparseView()), e);
  CHECK(constraints.redundant().size() == 2);
  slant::smalse const method{qp, constraints};
  auto const r = slant::solve(method, test::zeros(p.n), accurate(1e-11));
  CHECK(r.converged());
  CHECK((r.x() - p.x).norm() <= 1e-8);
  CHECK((rows.transpose() * method.multipliers(r.state) - p.G.transpose() * p.μ).norm() <= 1e-8);
}

TEST_CASE(
    "where space and set meet at a small angle the way is long, but nothing else is claimed") {
  for (double const θ : {0.3, 0.1, 0.02}) {
    CAPTURE(θ);
    test::wedge const w(θ);
    auto const qp = w.qp();
    auto const r = slant::solve(slant::smalse{qp, w.constraints}, test::zeros(2), accurate(1e-8));
    CAPTURE(r.reason);
    CHECK(!r.state.infeasible);
    CHECK((r.converged() || r.status == status::iteration_limit));
    // Each step leaves the fraction 1 − θ² of the error at most, and not much less.
    CHECK(r.converged() == (θ == 0.3));
  }
}

TEST_CASE("x waits in a corner of the set while the multiplier grows to what b asks for") {
  // x₁ ≥ 0, x₁ = 0.1: until ν has grown from 0 to b₁ − 0.1 no error falls, over a hundred steps.
  auto const a = slant::matrix<slant::self_adjoint, slant::positive_definite>(
      MatrixXd(MatrixXd::Identity(2, 2)));
  VectorXd const b{{-10, 0}};
  auto const set = slant::half_lines(2);
  slant::separable_qp const qp{a, b, set};
  slant::equality_constraints const constraints(sparse(MatrixXd{{1, 0}}.sparseView()),
                                                VectorXd{{0.1}});
  auto const r = slant::solve(slant::smalse{qp, constraints}, test::zeros(2), accurate(1e-10));
  CAPTURE(r.reason);
  CHECK(r.converged());
  CHECK(r.iterations() > 60);
  CHECK((r.x() - VectorXd{{0.1, 0}}).norm() <= 1e-10);
  // The same without a solution: told, and soon.
  slant::equality_constraints const beyond(sparse(MatrixXd{{1, 0}}.sparseView()), VectorXd{{-0.1}});
  auto const none = slant::solve(slant::smalse{qp, beyond}, test::zeros(2), accurate(1e-10));
  CHECK(none.state.infeasible);
  CHECK(none.iterations() <= 60);
}

TEST_CASE("going on from another point and multiplier") {
  known_problem const p;
  auto const qp = p.qp();
  auto const constraints = p.constraints();
  slant::smalse const method{qp, constraints};
  auto state = method.start(VectorXd::Zero(p.n));
  method.step(state);
  auto const solution = slant::solve(method, test::zeros(p.n), accurate(1e-12));
  method.resume(state, solution.x(), solution.state.ν);
  CHECK(state.reduced_gradient_norm <= 1e-10 * state.gradient_scale);
  CHECK(state.feasibility_norm <= 1e-11);
}

TEST_CASE(
    "L grows by half of ρ times the distance squared wherever M stays, which is but seldom not "
    "so") {
  known_problem const p;
  auto const qp = p.qp();
  auto const constraints = p.constraints();
  double last = 0, M = 0;
  int grown = 0, adapted = 0;
  auto const watch = [&](auto const& s) {
    if (s.iteration > 1) {
      double const enough =
          last + 0.5 * s.ρ * s.feasibility_norm * (s.feasibility_norm / s.inner.unit);
      double const noise = 1e-13 * std::abs(s.lagrangian);
      if (s.M < M) ++adapted;
      if (s.M == M) {
        ++grown;
        CHECK(s.lagrangian >= enough - noise);
      }
    }
    last = s.lagrangian;
    M = s.M;
  };
  auto const r = slant::solve(slant::smalse{qp, constraints}, VectorXd(VectorXd::Ones(p.n)),
                              accurate(1e-10), watch);
  CHECK(r.converged());
  CHECK(grown >= 5);
  CHECK(adapted <= 4);
  VectorXd const gradient = p.A * (r.x() - r.state.offset) - p.b +
                            p.G.transpose() * slant::smalse{qp, constraints}.multipliers(r.state);
  double const α = 1 / r.state.σ;
  VectorXd projected = r.x() - α * gradient;
  slant::project(qp.set(), VectorXd(projected), projected);
  CHECK((r.x() - projected).norm() / α <= 1e-8 * r.state.gradient_scale);
}

TEST_CASE("a function without minimum is told from one with") {
  // x_0 does not appear in q but by −x_0.
  MatrixXd const A = VectorXd{{0.0, 1.0, 2.0}}.asDiagonal();
  VectorXd const b{{1.0, 1.0, 1.0}};
  slant::separable_qp const qp{slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(A),
                               b, slant::half_lines(3)};
  MatrixXd const G{{0.0, 1.0, 1.0}};
  slant::equality_constraints const constraints(sparse(G.sparseView()),
                                                VectorXd(VectorXd::Ones(1)));
  auto const r = slant::solve(slant::smalse{qp, constraints}, test::zeros(3), accurate(1e-10));
  CHECK(r.status == status::unbounded);
}

TEST_CASE("no equations at all: the solution of KPRGP") {
  known_problem const p;
  auto const qp = p.qp();
  slant::equality_constraints const none(sparse(0, p.n), VectorXd(0));
  auto const free_run = slant::solve(slant::smalse{qp, none}, test::zeros(p.n), accurate(1e-10));
  auto const plain = test::minimise(slant::kprgp{qp}, test::zeros(p.n), 1e-11, 5000);
  CHECK(free_run.converged());
  CHECK((free_run.x() - plain.x()).norm() <= 1e-8);
}

}  // namespace smalse_test
