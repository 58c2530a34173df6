// SPDX-License-Identifier: MIT
//
// CG, BiCGSTAB and GMRES as linear solvers of Newton's method: as accurate as asked for, with a report
// that is true; statuses where there is nothing to solve.
#include <slant/slant.hpp>
#include <slant/testing/archetypes.hpp>

#include <slanting/slanting_support.hpp>
#include <support/testing.hpp>

namespace krylov_solvers_test {

using slant::bicgstab_solver;
using slant::cg_solver;
using slant::gmres_solver;
using slant::status;
using slanting_support::random_matrix;
using slanting_support::random_spd;
using slanting_support::random_vector;

struct result {
  VectorXd dy;
  slant::direction_report<double> report;
  slant::index applications;
};

/// What every solve must do: no allocation, a true count, finite numbers.
template <class Solver, class G, class Prepared>
result solve_in(Prepared& p, Solver const& solver, G const& g, VectorXd const& f, double η) {
  auto const counted = slant::counted(g);
  VectorXd dy = VectorXd::Constant(f.size(), NAN);
  slant::testing::allocation_guard guard;
  auto const report = solver.solve(counted, f, {η, f.norm()}, dy, p);
  auto const allocations = guard.count();
  CHECK(allocations == 0);
  CHECK(counted.applications() == report.operator_applications);
  CHECK(dy.allFinite());
  CHECK(std::isfinite(report.residual_norm));
  return {dy, report, counted.applications()};
}
template <class Solver, class G>
result solved(Solver const& solver, G const& g, VectorXd const& f, double η) {
  solver.validate();
  auto p = solver.prepare(slant::counted(g), f);
  return solve_in(p, solver, g, f, η);
}
/// The same of a matrix, with the residual that is reported.
template <class Solver>
result solved(Solver const& solver, MatrixXd const& m, VectorXd const& f, double η) {
  auto r = solved(solver, slant::matrix(m), f, η);
  double const rounding = 1e-14 * (f.norm() + m.norm() * r.dy.norm());
  CHECK(std::abs((f + m * r.dy).norm() - r.report.residual_norm) <= rounding + 1e-10 * f.norm());
  return r;
}
auto spd(MatrixXd const& m) {
  return slant::matrix<slant::self_adjoint, slant::positive_definite>(m);
}

/// A well-conditioned nonsymmetric matrix: eigenvalues in [1, 3] and a skew part.
MatrixXd nonsymmetric(Eigen::Index n) {
  MatrixXd a = VectorXd::LinSpaced(n, 1, 3).asDiagonal();
  for (Eigen::Index i = 0; i + 1 < n; ++i) {
    a(i, i + 1) += 0.7;
    a(i + 1, i) -= 0.7;
  }
  return a;
}

TEST_CASE("cg_solver: a sequence of definite systems in the memory of the first") {
  cg_solver const solver;
  auto p = solver.prepare(slant::counted(spd(random_spd(20, 1))), random_vector(20, 2));
  for (unsigned seed : {1U, 5U, 9U}) {
    MatrixXd const m = random_spd(20, seed);
    VectorXd const f = std::ldexp(1.0, 100 * (int(seed) - 5)) * random_vector(20, seed + 1);
    auto const r = solve_in(p, solver, spd(m), f, 1e-9);
    CHECK(r.report.status == status::converged);
    CHECK(r.applications == r.report.iterations);
    double const residual = (f + m * r.dy).norm();
    CHECK(std::abs(residual - r.report.residual_norm) <= 1e-13 * f.norm());
    CHECK(residual <= 1.001e-9 * f.norm());
  }
}

TEST_CASE("bicgstab_solver: a nonsymmetric system, as accurately as asked for") {
  MatrixXd const m = random_spd(20, 1) + 3 * random_matrix(20, 20, 2);
  VectorXd const f = random_vector(20, 3);
  VectorXd const exact = slanting_support::solve(m, VectorXd(-f));
  for (double η : {0.5, 1e-4, 1e-11}) {
    auto const r = solved(bicgstab_solver{}, m, f, η);
    CHECK(r.report.status == status::converged);
    CHECK(r.report.residual_norm <= η * f.norm());
    CHECK(r.applications <= 2 * r.report.iterations);
    CHECK(r.applications >= 2 * r.report.iterations - 1);  // the last step may end half way
    if (η < 1e-10) CHECK((r.dy - exact).norm() <= 1e-8 * exact.norm());
  }
}

TEST_CASE("gmres_solver: an application a step, and one for a small residual") {
  MatrixXd const A = nonsymmetric(40);
  VectorXd const f = VectorXd::LinSpaced(40, -1, 2);
  for (double const η : {1e-2, 1e-6, 1e-12}) {
    CAPTURE(η);
    auto const r = solved(gmres_solver{}, A, f, η);
    CHECK(r.report.status == status::converged);
    CHECK(r.applications == r.report.iterations + (η < 1e-8 ? 1 : 0));
    CHECK((f + A * r.dy).norm() <= 1.001 * η * f.norm() + 1e-14);
  }
}

TEST_CASE("gmres_solver: of all vectors of the Krylov space the one with the smallest residual") {
  MatrixXd const A = nonsymmetric(12);
  VectorXd const f = VectorXd::LinSpaced(12, 1, 3);
  for (Eigen::Index steps = 1; steps <= 5; ++steps) {
    MatrixXd images(12, steps);
    VectorXd v = f;
    for (Eigen::Index j = 0; j < steps; ++j) images.col(j) = v = A * v;
    VectorXd const best = f - images * images.colPivHouseholderQr().solve(f);
    auto const r = solved(gmres_solver{.max_iterations = steps}, A, f, 0);
    CHECK(r.report.status == status::iteration_limit);
    CHECK(r.report.iterations == steps);
    CHECK((f + A * r.dy).norm() == doctest::Approx(best.norm()).epsilon(1e-8));
  }
}

TEST_CASE("gmres_solver: few vectors: begins anew, arrives later, an application more a restart") {
  MatrixXd const A = nonsymmetric(40);
  VectorXd const f = VectorXd::LinSpaced(40, -1, 2);
  auto const whole = solved(gmres_solver{}, A, f, 1e-10);
  auto const r = solved(gmres_solver{.restart = 6}, A, f, 1e-10);
  CHECK(r.report.status == status::converged);
  CHECK(r.report.iterations > whole.report.iterations);
  CHECK(r.applications == r.report.iterations + (r.report.iterations + 5) / 6);
  CHECK((f + A * r.dy).norm() <= 1.001e-10 * f.norm());
}

TEST_CASE("gmres_solver: nearly singular: the residual reported is that of dy") {
  MatrixXd hilbert(14, 14);
  for (Eigen::Index i = 0; i < 14; ++i)
    for (Eigen::Index j = 0; j < 14; ++j) hilbert(i, j) = 1 / double(i + j + 1);
  VectorXd const f = VectorXd::LinSpaced(14, -1, 2);
  for (double const η : {1e-4, 1e-8, 1e-12, 0.0}) {
    for (slant::index const restart : {60, 5}) {
      CAPTURE(η);
      CAPTURE(restart);
      auto const r = solved(gmres_solver{.restart = restart}, slant::matrix(hilbert), f, η);
      double const residual = (f + hilbert * r.dy).norm();
      CHECK(std::fabs(r.report.residual_norm - residual) <=
            1e-14 * (f.norm() + hilbert.norm() * r.dy.norm()));
      CHECK(residual <= 1.001 * f.norm());
      if (r.report.status == status::converged)
        CHECK(r.report.residual_norm <= std::max(η, 1e-15) * f.norm());
    }
  }
}

TEST_CASE("gmres_solver: any scale, of the operator and of the right-hand side") {
  MatrixXd const A = nonsymmetric(10);
  VectorXd const f = VectorXd::LinSpaced(10, 1, 2);
  auto const plain = solved(gmres_solver{}, A, f, 1e-10);
  for (double const a : {1e-150, 1e150}) {
    for (double const b : {1e-100, 1e100}) {
      auto const r = solved(gmres_solver{}, slant::matrix(MatrixXd(a * A)), b * f, 1e-10);
      CHECK(r.report.status == status::converged);
      CHECK((r.dy * (a / b) - plain.dy).norm() <= 1e-9 * plain.dy.norm());
    }
  }
}

/// An operator that has left the range of its scalar.
struct no_numbers {
  [[nodiscard]] slant::index rows() const { return 3; }
  [[nodiscard]] slant::index cols() const { return 3; }
  void apply(VectorXd const&, VectorXd& y) const { y.setConstant(NAN); }
};

TEST_CASE("what cannot be solved is a status, and dy the best there was") {
  VectorXd const first = VectorXd::Unit(3, 0);
  auto const check = [&](auto const& solver) {
    auto const zero = solved(solver, MatrixXd(MatrixXd::Zero(3, 3)), first, 1e-10);
    CHECK(zero.report.status == status::breakdown);
    CHECK(zero.report.residual_norm == 1);
    CHECK(zero.dy == VectorXd::Zero(3));
    auto const infinite = solved(solver, no_numbers{}, first, 0.1);
    CHECK(infinite.report.status == status::breakdown);
    CHECK(infinite.dy == VectorXd::Zero(3));
    // An equation that holds for nothing, and one that holds for everything.
    MatrixXd A = nonsymmetric(6);
    A.row(5).setZero();
    A.col(5).setZero();
    VectorXd f = VectorXd::Ones(6);
    auto const part = solved(solver, A, f, 1e-12);
    CHECK(part.report.status != status::converged);
    CHECK((f + A * part.dy).norm() <= 1.001 * f.norm());
    f(5) = 0;
    auto const consistent = solved(solver, A, f, 1e-12);
    CHECK(consistent.report.status == status::converged);
    CHECK((f + A * consistent.dy).norm() <= 1e-11);
  };
  check(bicgstab_solver{});
  check(gmres_solver{});

  MatrixXd nilpotent = MatrixXd::Zero(3, 3);
  nilpotent(1, 0) = 1;
  auto const none = solved(bicgstab_solver{}, nilpotent, first, 1e-10);
  CHECK(none.report.status != status::converged);
  CHECK(none.report.residual_norm == 1);
  CHECK(none.dy == VectorXd::Zero(3));
  MatrixXd half = MatrixXd::Identity(4, 4);
  half(2, 2) = half(3, 3) = 0;
  auto const part = solved(bicgstab_solver{}, half, VectorXd::Ones(4), 1e-10);
  CHECK(part.report.status != status::converged);
  CHECK(part.report.residual_norm == doctest::Approx(std::sqrt(2.0)));
  MatrixXd const indefinite = VectorXd{{1.0, -1.0}}.asDiagonal();
  CHECK(solved(cg_solver{}, spd(indefinite), VectorXd::Ones(2), 1e-8).report.status ==
        status::breakdown);
}

TEST_CASE("limits and options; who is taken") {
  auto const limited = solved(bicgstab_solver{.max_iterations = 3},
                              MatrixXd(random_matrix(30, 30, 6)), random_vector(30, 7), 1e-12);
  CHECK(limited.report.status == status::iteration_limit);
  CHECK(limited.report.iterations == 3);
  auto const message = [](auto const& solver) { return SLANT_COMPLAINT(solver.validate()); };
  CHECK(message(cg_solver{.max_iterations = -1}) ==
        "max_iterations: got -1, expected a number >= 0");
  CHECK(message(gmres_solver{.max_iterations = -1}) ==
        "max_iterations: got -1, expected a number >= 0");
  CHECK(message(gmres_solver{.restart = 0}) == "restart: got 0, expected at least 1");
  namespace archetype = slant::testing::archetype;
  static_assert(slant::direction_solver<cg_solver, archetype::spd_operator, archetype::vector>);
  static_assert(!slant::direction_solver<cg_solver, archetype::psd_operator, archetype::vector>);
}

}  // namespace krylov_solvers_test
