// SPDX-License-Identifier: MIT
#include <slant/newton/krylov_solvers.hpp>

#include <slant/operators/counted.hpp>
#include <slant/operators/matrix.hpp>

#include <doctest/doctest.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <string>
#include <support/allocation_guard.hpp>

namespace gmres_solver_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using request = slant::direction_request<double>;

/// A well-conditioned nonsymmetric matrix: eigenvalues in [1, 3] and a skew part.
MatrixXd nonsymmetric(Eigen::Index n) {
  MatrixXd a = VectorXd::LinSpaced(n, 1, 3).asDiagonal();
  for (Eigen::Index i = 0; i + 1 < n; ++i) {
    a(i, i + 1) += 0.7;
    a(i + 1, i) -= 0.7;
  }
  return a;
}

/// An operator that has left the range of its scalar.
struct no_numbers {
  [[nodiscard]] slant::index rows() const { return 3; }
  [[nodiscard]] slant::index cols() const { return 3; }
  void apply(VectorXd const&, VectorXd& y) const { y.setConstant(NAN); }
};

struct solved {
  VectorXd dy;
  slant::direction_report<double> report;
};
template <class G>
solved run(G const& g, VectorXd const& f, double tolerance, slant::gmres_solver solver = {}) {
  solver.validate();
  auto memory = solver.prepare(g, f);
  VectorXd dy = VectorXd::Constant(f.size(), NAN);
  slant::testing::allocation_guard guard;
  auto const report = solver.solve(g, f, request{tolerance, f.norm()}, dy, memory);
  auto const allocations = guard.count();
  CHECK(allocations == 0);
  return {dy, report};
}

TEST_CASE("the residual asked for, at an application a step, and one for a small residual") {
  MatrixXd const A = nonsymmetric(40);
  VectorXd const f = VectorXd::LinSpaced(40, -1, 2);
  for (double const tolerance : {1e-2, 1e-6, 1e-12}) {
    CAPTURE(tolerance);
    auto const r = run(slant::matrix(A), f, tolerance);
    CHECK(r.report.status == slant::status::converged);
    CHECK(r.report.operator_applications == r.report.iterations + (tolerance < 1e-8 ? 1 : 0));
    CHECK((f + A * r.dy).norm() <= 1.001 * tolerance * f.norm() + 1e-14);
    CHECK(r.report.residual_norm == doctest::Approx((f + A * r.dy).norm()).epsilon(1e-2));
  }
}

TEST_CASE("of all vectors of the Krylov space the one with the smallest residual") {
  MatrixXd const A = nonsymmetric(12);
  VectorXd const f = VectorXd::LinSpaced(12, 1, 3);
  for (Eigen::Index steps = 1; steps <= 5; ++steps) {
    MatrixXd images(12, steps);
    VectorXd v = f;
    for (Eigen::Index j = 0; j < steps; ++j) images.col(j) = v = A * v;
    VectorXd const best = f - images * images.colPivHouseholderQr().solve(f);
    auto const r = run(slant::matrix(A), f, 0, {.max_iterations = steps});
    CHECK(r.report.status == slant::status::iteration_limit);
    CHECK(r.report.iterations == steps);
    CHECK((f + A * r.dy).norm() == doctest::Approx(best.norm()).epsilon(1e-8));
  }
}

TEST_CASE("few vectors: begins anew and arrives later, at an application more a restart") {
  MatrixXd const A = nonsymmetric(40);
  VectorXd const f = VectorXd::LinSpaced(40, -1, 2);
  auto const whole = run(slant::matrix(A), f, 1e-10);
  auto const counted = slant::counted(slant::matrix(A));
  auto const r = run(counted, f, 1e-10, {.restart = 6});
  CHECK(r.report.status == slant::status::converged);
  CHECK(r.report.iterations > whole.report.iterations);
  CHECK(r.report.operator_applications == r.report.iterations + (r.report.iterations + 5) / 6);
  CHECK(counted.applications() == r.report.operator_applications);
  CHECK((f + A * r.dy).norm() <= 1.001e-10 * f.norm());
}

TEST_CASE(
    "nearly singular operators: the residual reported is that of dy, whatever was hoped for") {
  MatrixXd hilbert(14, 14);
  for (Eigen::Index i = 0; i < 14; ++i) {
    for (Eigen::Index j = 0; j < 14; ++j) hilbert(i, j) = 1 / double(i + j + 1);
  }
  VectorXd const f = VectorXd::LinSpaced(14, -1, 2);
  for (double const tolerance : {1e-4, 1e-8, 1e-12, 0.0}) {
    for (slant::index const restart : {60, 5}) {
      CAPTURE(tolerance);
      CAPTURE(restart);
      auto const r = run(slant::matrix(hilbert), f, tolerance, {.restart = restart});
      double const rounding = 1e-14 * (f.norm() + hilbert.norm() * r.dy.norm());
      double const residual = (f + hilbert * r.dy).norm();
      CHECK(std::fabs(r.report.residual_norm - residual) <= rounding);
      CHECK(residual <= 1.001 * f.norm());
      if (r.report.status == slant::status::converged) {
        CHECK(r.report.residual_norm <= std::max(tolerance, 1e-15) * f.norm());
      }
    }
  }
}

TEST_CASE("any scale, of the operator and of the right-hand side") {
  MatrixXd const A = nonsymmetric(10);
  VectorXd const f = VectorXd::LinSpaced(10, 1, 2);
  auto const plain = run(slant::matrix(A), f, 1e-10);
  for (double const a : {1e-150, 1e150}) {
    for (double const b : {1e-100, 1e100}) {
      auto const r = run(slant::matrix(MatrixXd(a * A)), b * f, 1e-10);
      CHECK(r.report.status == slant::status::converged);
      CHECK((r.dy * (a / b) - plain.dy).norm() <= 1e-9 * plain.dy.norm());
    }
  }
}

TEST_CASE(
    "singular operators: solved where that is possible, else the best there is and a status") {
  MatrixXd A = nonsymmetric(6);
  A.row(5).setZero();
  A.col(5).setZero();
  VectorXd f = VectorXd::Ones(6);
  f(5) = 0;
  auto const consistent = run(slant::matrix(A), f, 1e-12);
  CHECK(consistent.report.status == slant::status::converged);
  CHECK((f + A * consistent.dy).norm() <= 1e-11);
  f(5) = 1;
  auto const not_consistent = run(slant::matrix(A), f, 1e-12);
  CHECK(not_consistent.report.status != slant::status::converged);
  CHECK(not_consistent.dy.allFinite());
  CHECK((f + A * not_consistent.dy).norm() <= 1.001 * f.norm());
  auto const zero = run(slant::matrix(MatrixXd(MatrixXd::Zero(3, 3))), VectorXd::Ones(3), 0.1);
  CHECK(zero.report.status == slant::status::breakdown);
  CHECK(zero.dy.norm() == 0);
  auto const infinite = run(no_numbers{}, VectorXd::Ones(3), 0.1);
  CHECK(infinite.report.status == slant::status::breakdown);
  CHECK(infinite.dy.norm() == 0);
}

TEST_CASE("options out of range are refused") {
  auto const message = [](slant::gmres_solver const& solver) -> std::string {
    try {
      solver.validate();
    } catch (slant::bad_input const& e) {
      return e.what();
    }
    return "accepted";
  };
  CHECK(message({.restart = 0}) == "restart: got 0, expected at least 1");
  CHECK(message({.max_iterations = -1}) == "max_iterations: got -1, expected a number >= 0");
}

}  // namespace gmres_solver_test
