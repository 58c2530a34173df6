// SPDX-License-Identifier: MIT
#include <slant/certificates/constrained_certificate.hpp>
#include <slant/methods/solve_constrained_program.hpp>
#include <slant/operators/counted.hpp>

#include <methods/equality_scenes.hpp>
#include <support/testing.hpp>
#include "made_programs.hpp"

namespace constrained_certificate_test {

/// A program that is made from its solution, with random equations that hold there.
struct constrained_program : test::made_program {
  sparse G;
  VectorXd e;

  constrained_program(int blocks, double log_condition, int equations, std::mt19937& random)
      : made_program(test::make_program(blocks, log_condition, random)) {
    std::normal_distribution<double> gauss;
    auto const entry = [&] { return gauss(random); };
    MatrixXd const rows = MatrixXd::NullaryExpr(equations, b.size(), entry);
    G = rows.sparseView();
    e = rows * solution;
    b += rows.transpose() * VectorXd::NullaryExpr(equations, entry);
  }
  [[nodiscard]] auto program() const {
    return slant::minimise(
               slant::quadratic(
                   slant::matrix<slant::self_adjoint, slant::positive_definite>(MatrixXd(A)), b))
        .over(slant::cartesian(slant::half_lines(g.size()), slant::discs(g)))
        .subject_to(G, e);
  }
};

TEST_CASE("random programs with equations: what is claimed holds, and is hardly more") {
  std::mt19937 random(3);
  int sharp = 0, telling = 0, solved = 0, all = 0;
  for (int run = 0; run < 120; ++run) {
    constrained_program const p(2 + run % 2, run % 7, 1 + run % 4, random);
    double const size = test::energy_norm(p.A, p.solution), floor = 10 * p.lost / size;
    for (double const tolerance : {1e-3, 1e-9}) {
      CAPTURE(run);
      CAPTURE(tolerance);
      auto const r = slant::solve(p.program(), tolerance);
      CAPTURE(r.reason);
      ++all;
      if (!r.converged()) continue;
      ++solved;
      double const error = test::energy_norm(p.A, r.x() - p.solution) / size;
      CHECK(error <= tolerance + floor);
      if (error < 100 * floor) continue;
      ++telling;
      sharp += r.error.relative() <= 10 * error ? 1 : 0;
    }
  }
  CHECK(solved == all);
  CHECK(telling >= 60);
  CHECK(sharp >= 0.8 * telling);
}

TEST_CASE("a residual of 1e-3 with an error of 900 %, in a wedge: the certificate denies it") {
  VectorXd const x{{1.0, 0.0}};
  for (double const θ : {0.3, 1e-4}) {
    CAPTURE(θ);
    test::wedge const w(θ);
    auto const qp = w.qp();
    slant::constrained_certificate certificate(qp, w.constraints);
    auto const by_residuals =
        slant::solve(slant::smalse{qp, w.constraints}, test::zeros(2),
                     (slant::reduced_gradient_below(1e-3) && slant::feasibility_below(1e-3)) ||
                         slant::at_most(400));
    CHECK(by_residuals.converged());
    CHECK((by_residuals.x() - x).norm() >= (θ == 0.3 ? 2e-3 : 8));
    CHECK(certificate(by_residuals.x(), by_residuals.state.ν).relative() >=
          (by_residuals.x() - x).norm());
    auto const denied =
        slant::solve(slant::smalse{qp, w.constraints}, test::zeros(2),
                     slant::energy_error_below(1e-3, std::ref(certificate)) || slant::at_most(400));
    CHECK(denied.converged() == (θ == 0.3));
    if (denied.converged()) CHECK((denied.x() - x).norm() <= 1e-3);
    auto const newton =
        slant::solve(slant::constrained_newton{qp, w.constraints}, test::zeros(2),
                     slant::energy_error_below(1e-10, std::ref(certificate)) || slant::at_most(20));
    CHECK(newton.converged());
    CHECK((newton.x() - x).norm() <= 1e-10);
  }
}

TEST_CASE("an angle below the root of the precision: no claim that is wrong") {
  for (double const θ : {1e-7, 1e-9, 1e-12}) {
    CAPTURE(θ);
    test::wedge w(θ);
    w.b(0) = 1 + 1e-6;  // pulls to 1 + 1e-6, which misses the equation by less than rounding
    auto const qp = w.qp();
    slant::constrained_certificate certificate(qp, w.constraints);
    auto const run =
        slant::solve(slant::constrained_newton{qp, w.constraints}, test::zeros(2),
                     slant::energy_error_below(1e-8, std::ref(certificate)) || slant::at_most(400));
    CHECK((!run.converged() || (run.x() - VectorXd{{1.0, 0.0}}).norm() <= 1e-8));
  }
}

TEST_CASE("any units and lengths; a singular A; products are counted, nothing is allocated") {
  for (auto const& [unit, length] : {std::array{1.0, 1.0}, std::array{1e140, 1.0},
                                     std::array{1e-140, 1.0}, std::array{1.0, 1e-100}}) {
    for (int const rank : {test::known_problem::n, 20}) {
      CAPTURE(unit);
      CAPTURE(length);
      CAPTURE(rank);
      test::known_problem const p(unit, rank, length);
      auto const A = slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(p.A);
      auto const counted = slant::counted(A);
      slant::separable_qp const qp{counted, p.b, p.set()};
      auto const constraints = p.constraints();
      slant::constrained_certificate certificate(qp, constraints);
      VectorXd ν(p.n);
      slant::apply(constraints.range_projector(), VectorXd(p.A * p.x - p.b), ν);
      ν += p.G.transpose() * p.μ;
      VectorXd const x =
          slant::project(qp.set(), VectorXd(p.x + length * 1e-5 * test::random_matrix(24, 1, 9)));
      static_cast<void>(certificate(x, ν));
      slant::testing::allocation_guard guard;
      auto const e = certificate(x, ν);
      auto const allocations = guard.count();
      CHECK(allocations == 0);
      VectorXd const d = (x - p.x) / length, whole = p.x / length;
      double const error = std::sqrt(d.dot(p.A / unit * d) / whole.dot(p.A / unit * whole));
      CHECK(e.relative() >= 0.6 * error);
      CHECK(e.relative() <= 10 * error);
      CHECK(!e.proven);
      CHECK(certificate.applications() == counted.applications());
    }
  }
}

TEST_CASE("as many equations as unknowns, equations that depend on others on the face") {
  VectorXd const b{{1.0, 2.0, 3.0}};
  auto const A = slant::identity(3);
  slant::separable_qp const qp{A, b, slant::half_lines(3)};
  auto const error_at = [&](MatrixXd const& G, VectorXd const& e, VectorXd const& x) {
    slant::equality_constraints const c(sparse(G.sparseView()), e);
    slant::constrained_certificate certificate(qp, c);
    auto const run =
        slant::solve(slant::constrained_newton{qp, c}, test::zeros(3),
                     slant::energy_error_below(1e-12, std::ref(certificate)) || slant::at_most(50));
    CAPTURE(run.reason);
    CHECK(run.converged());
    return (run.x() - x).norm();
  };
  VectorXd const point{{1.0, 0.0, 2.0}};
  CHECK(error_at(MatrixXd::Identity(3, 3), point, point) <= 1e-12);
  // x₀ = x₁ + 1 and x₀ = 1 + 2 x₁ with x₁ = 0 at its bound: the same equation on that face.
  MatrixXd const G{{1.0, -1.0, 0.0}, {1.0, -2.0, 0.0}};
  CHECK(error_at(G, VectorXd{{1.0, 1.0}}, VectorXd{{1.0, 0.0, 3.0}}) <= 1e-12);
}

TEST_CASE("sizes that do not match are refused") {
  test::known_problem const p;
  auto const qp = p.qp();
  slant::equality_constraints const other(sparse(1, 3), test::zeros(1));
  CHECK_THROWS_AS((slant::constrained_certificate{qp, other}), slant::bad_input);
  auto const constraints = p.constraints();
  auto const I = slant::identity(3);
  CHECK_THROWS_AS((slant::constrained_certificate{qp, constraints, I}), slant::bad_input);
}

}  // namespace constrained_certificate_test
