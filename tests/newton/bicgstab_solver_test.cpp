// SPDX-License-Identifier: MIT
#include <slant/newton/krylov_solvers.hpp>
#include <slant/operators/counted.hpp>
#include <slant/operators/matrix.hpp>

#include <slanting/slanting_support.hpp>
#include <support/allocation_guard.hpp>

#include <doctest/doctest.h>

namespace bicgstab_solver_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

struct result {
  slant::direction_report<double> report;
  VectorXd dy;
  slant::index applications;
};

result solve(MatrixXd const& m, VectorXd const& f, double η,
             slant::bicgstab_solver const& solver = {}) {
  auto const G = slant::counted(slant::matrix(m));
  auto p = solver.prepare(G, f);
  result r{{}, VectorXd::Constant(f.size(), std::nan("")), 0};
  r.report = solver.solve(G, f, {η, f.norm(), 0}, r.dy, p);
  r.applications = G.applications();
  CHECK(r.report.operator_applications == r.applications);
  CHECK(r.dy.allFinite());
  CHECK(std::isfinite(r.report.residual_norm));
  CHECK(std::abs((f + m * r.dy).norm() - r.report.residual_norm) <= 1e-10 * f.norm());
  return r;
}

TEST_CASE("a nonsymmetric system, as accurately as asked for") {
  MatrixXd const m =
      slanting_support::random_spd(20, 1) + 3 * slanting_support::random_matrix(20, 20, 2);
  VectorXd const f = slanting_support::random_vector(20, 3);
  VectorXd const exact = slanting_support::solve(m, VectorXd(-f));
  for (double η : {0.5, 1e-4, 1e-11}) {
    auto const r = solve(m, f, η);
    CHECK(r.report.status == slant::status::converged);
    CHECK(r.report.residual_norm <= η * f.norm());
    CHECK(r.applications <= 2 * r.report.iterations);
    CHECK(r.applications >= 2 * r.report.iterations - 1);  // the last step may end half way
    if (η < 1e-10) CHECK((r.dy - exact).norm() <= 1e-8 * exact.norm());
  }
}

TEST_CASE("where BiCGSTAB breaks down: r̂ᵀG r = 0 at the start, and a skew G") {
  MatrixXd start(3, 3);
  start << 0, 1, 0,  // fᵀG f = 0 for f = e₁
      1, 1, 1,       //
      0, 1, 2;
  auto const mended = solve(start, VectorXd::Unit(3, 0), 1e-10);
  CHECK(mended.report.status == slant::status::converged);

  MatrixXd const m = slanting_support::random_matrix(10, 10, 4);
  auto const skew = solve(m - m.transpose(), slanting_support::random_vector(10, 5), 1e-7);
  CHECK(skew.report.status == slant::status::converged);
}

TEST_CASE("what cannot be solved is a status, and dy the best there was") {
  VectorXd const f = VectorXd::Unit(3, 0);
  auto const zero = solve(MatrixXd::Zero(3, 3), f, 1e-10);
  CHECK(zero.report.status == slant::status::breakdown);
  CHECK(zero.report.residual_norm == 1);
  CHECK(zero.dy == VectorXd::Zero(3));

  MatrixXd nilpotent = MatrixXd::Zero(3, 3);
  nilpotent(1, 0) = 1;
  auto const none = solve(nilpotent, f, 1e-10);
  CHECK(none.report.status != slant::status::converged);
  CHECK(none.report.residual_norm == 1);
  CHECK(none.dy == VectorXd::Zero(3));

  // Half of the equations can be solved.
  MatrixXd half = MatrixXd::Identity(4, 4);
  half(2, 2) = half(3, 3) = 0;
  auto const part = solve(half, VectorXd::Ones(4), 1e-10);
  CHECK(part.report.status != slant::status::converged);
  CHECK(part.report.residual_norm == doctest::Approx(std::sqrt(2.0)));

  MatrixXd const hard = slanting_support::random_matrix(30, 30, 6);
  auto const limited = solve(hard, slanting_support::random_vector(30, 7), 1e-12,
                             slant::bicgstab_solver{.max_iterations = 3});
  CHECK(limited.report.status == slant::status::iteration_limit);
  CHECK(limited.report.iterations == 3);
}

TEST_CASE("a G full of NaN is a breakdown, not a NaN") {
  using matrix = slant::matrix_operator<MatrixXd>;
  matrix const good{slant::held<MatrixXd>(MatrixXd::Identity(2, 2))};
  matrix const bad{slant::held<MatrixXd>(MatrixXd::Constant(2, 2, std::nan("")))};
  VectorXd const f = VectorXd::Ones(2);
  slant::bicgstab_solver const solver;
  auto p = solver.prepare(good, f);
  VectorXd dy(2);
  auto const r = solver.solve(bad, f, {0.1, f.norm(), 0}, dy, p);
  CHECK(r.status == slant::status::breakdown);
  CHECK(dy == VectorXd::Zero(2));
}

TEST_CASE("nothing is allocated between prepare and the end") {
  MatrixXd const m =
      slanting_support::random_spd(20, 1) + slanting_support::random_matrix(20, 20, 2);
  auto const G = slant::matrix(m);
  VectorXd const f = slanting_support::random_vector(20, 3);
  slant::bicgstab_solver const solver;
  auto p = solver.prepare(G, f);
  VectorXd dy(20);
  slant::testing::allocation_guard const guard;
  auto const r = solver.solve(G, f, {1e-9, f.norm(), 0}, dy, p);
  auto const allocations = guard.count();
  CHECK(allocations == 0);
  CHECK(r.status == slant::status::converged);
}

}  // namespace bicgstab_solver_test
