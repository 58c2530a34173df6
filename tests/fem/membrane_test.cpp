// SPDX-License-Identifier: MIT
//
// The obstacle problems against values that others have printed and against dense matrices.
#include <slant/iteration/solve.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/operators/matrix.hpp>
#include <slant/problems/separable_qp.hpp>
#include <slant/sets/contact_sets.hpp>

#include <fem/double_obstacle.hpp>
#include <fem/elastic_torsion.hpp>
#include <fem/grid_prolongation.hpp>
#include <fem/incomplete_five_point.hpp>
#include <fem/journal_bearing.hpp>
#include <fem/lower_obstacle.hpp>
#include <fem/membrane_contact.hpp>
#include <fem/printed_membranes.hpp>
#include <oracle/dense_newton.hpp>
#include <oracle/naive_membrane.hpp>
#include <support/minimise.hpp>
#include <support/testing.hpp>

namespace membrane_test {

/// The solution for A, b, l and u, with the preconditioner and ρ of m.
template <class A>
auto run_newton(fem::membrane<> const& m, A const& a, VectorXd const& start,
                double tolerance = 1e-12) {
  auto const set = slant::intervals(m.lower, m.upper);
  auto const report =
      test::minimise(slant::symmetric_newton{slant::separable_qp{a, m.b, set},
                                             fem::incomplete_five_point<>(m.A),
                                             {.step_length = 2 / m.A.largest_eigenvalue_bound()}},
                     start, tolerance, 300);
  CHECK(report.converged());
  return report;
}

VectorXd solve(fem::membrane<> const& m) {
  return run_newton(m, m.A, VectorXd::Zero(m.grid.size())).x();
}

TEST_CASE("optimal values that PETSc, COPS and CUTEst print") {
  auto const check = [](fem::membrane<> const& m, fem::printed_membrane const& printed) {
    CAPTURE(printed.nx);
    CAPTURE(printed.parameter);
    CHECK(std::fabs(fem::membrane_energy(m, solve(m)) - printed.value) <= printed.last_digit);
  };
  auto const most = test::effort<Eigen::Index>(10000, 1000);  // unknowns
  for (auto const& p : fem::printed_bearings)
    if (p.nx * p.ny <= most)
      check(fem::make_journal_bearing<>(p.nx, p.ny, {.eccentricity = p.parameter}), p);
  for (auto const& p : fem::printed_torsions)
    if (p.nx * p.ny <= most) check(fem::make_elastic_torsion(p.nx, p.ny, p.parameter), p);
}

/// A as CUTEst's OBSTCL problems have it: of the squares of the differences along the edges between
/// a node and the edge of the rectangle, a quarter and not a half.
Eigen::SparseMatrix<double> cutest_matrix(fem::five_point<> const& a) {
  Eigen::SparseMatrix<double> A = a.matrix();
  for (Eigen::Index j = 0; j < a.ny(); ++j)
    for (Eigen::Index i = 0; i < a.nx(); ++i) {
      double& diagonal = A.coeffRef(i + a.nx() * j, i + a.nx() * j);
      if (i == 0) diagonal -= a.along_x()[0] / 2;
      if (i + 1 == a.nx()) diagonal -= a.along_x()[a.nx()] / 2;
      if (j == 0) diagonal -= a.along_y()[i] / 2;
      if (j + 1 == a.ny()) diagonal -= a.along_y()[i] / 2;
    }
  return A;
}

// Remarks SOLTN in OBSTCLAE.SIF and OBSTCLBM.SIF. Of OBSTCLAE eight decimals: in the ninth its list
// and that of OBSTCLAL, the same problem from another start, differ.
TEST_CASE("CUTEst's obstacles: loads and bounds") {
  auto const check = [](fem::membrane<> const& m, double printed) {
    Eigen::SparseMatrix<double> const A = cutest_matrix(m.A);
    auto const a = slant::matrix<slant::self_adjoint, slant::positive_definite>(A);
    VectorXd const v = run_newton(m, a, VectorXd::Zero(m.grid.size())).x();
    CAPTURE(m.grid.nx);
    CHECK(std::fabs(v.dot(A * v) / 2 - m.b.dot(v) - printed) <= 1e-8);
  };
  check(fem::make_lower_obstacle<>(8, 8), 1.39789756);
  check(fem::make_lower_obstacle<>(30, 30), 1.74827003);
  check(fem::make_double_obstacle<>(8, 8), 2.87503823);
  check(fem::make_double_obstacle<>(30, 30), 6.88708670);
}

TEST_CASE("a dense method agrees, node by node, and in what it touches") {
  int const nx = test::effort(11, 6);
  int const ny = nx - 2;
  auto const check = [&](fem::membrane<> const& m, auto const& w) {
    auto const& g = m.grid;
    auto const A = oracle::naive_stiffness(nx, ny, g.width, g.height, w);
    oracle::dense_qp plain{A.template cast<double>(), m.b.cast<oracle::real>()};
    for (Eigen::Index i = 0; i < m.b.size(); ++i)
      plain.intervals.push_back({i, m.lower[i], m.upper[i]});
    oracle::real_vector const exact = oracle::solve_dense(plain).x;
    VectorXd const v = solve(m);
    CHECK((v - exact.cast<double>()).cwiseAbs().maxCoeff() < 1e-10 * v.cwiseAbs().maxCoeff());

    auto const contact = fem::find_contact(m, v);
    oracle::real_vector const r = plain.gradient(exact);
    int differences = 0;
    for (Eigen::Index i = 0; i < v.size(); ++i) {
      // The reaction has the sign of its obstacle, and none acts in between.
      long double const noise = 1e-15L * A(i, i) * exact.cwiseAbs().maxCoeff();
      int const expected = r[i] > noise ? -1 : r[i] < -noise ? 1 : 0;
      differences += contact.state[i] != expected;
    }
    CHECK(differences == 0);
    CHECK(contact.count(fem::membrane_state::free) < v.size());
    CHECK(((contact.reaction * (g.hx() * g.hy()) - r.cast<double>()).cwiseAbs().maxCoeff() <
           1e-8 * m.A.largest_eigenvalue_bound() * v.cwiseAbs().maxCoeff()));
  };
  auto const one = [](long double) { return 1.0L; };
  check(fem::make_elastic_torsion<>(nx, ny), one);
  check(fem::make_elastic_torsion<>(nx, ny, 20), one);
  check(fem::make_journal_bearing<>(nx, ny, {.eccentricity = 0.5, .b = 2}), [](long double x) {
    long double const gap = 1 + 0.5L * std::cos(x);
    return gap * gap * gap;
  });
  check(fem::make_lower_obstacle<>(nx, ny), one);
  check(fem::make_double_obstacle<>(nx, ny), one);
}

TEST_CASE("from a coarse grid: few steps, however fine the grid is") {
  // Without optimisation two grids; the steps are counted all the same.
  int const finest = test::effort(128, 32);
  auto const check = [&](auto const& make) {
    fem::membrane<> coarse = make(8);
    VectorXd v = solve(coarse);
    for (int n = 16; n <= finest; n *= 2) {
      fem::membrane<> const m = make(n);
      VectorXd const start = fem::grid_prolongation(coarse.grid, m.grid) * v;
      auto const report = run_newton(m, m.A, start, 1e-8);
      CAPTURE(n);
      CHECK(report.iterations() <= 10);
      CHECK(report.state.work.operator_applications <= 100);
      v = report.x();
      coarse = m;
    }
  };
  check([](int n) { return fem::make_elastic_torsion<>(n, n); });
  check([](int n) { return fem::make_journal_bearing<>(n, n); });
  check([](int n) { return fem::make_lower_obstacle<>(n, n); });
  check([](int n) { return fem::make_double_obstacle<>(n, n); });
}

TEST_CASE("data out of range are refused") {
  CHECK_THROWS_WITH_AS((void)fem::make_journal_bearing<>(3, 3, {.eccentricity = 1}),
                       "eccentricity: got 1, expected a number in (0, 1)", std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)fem::make_journal_bearing<>(3, 3, {.b = -1}),
                       "b: got -1, expected a number > 0", std::invalid_argument);
  CHECK_THROWS_AS((void)fem::make_elastic_torsion<>(0, 3), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)fem::find_contact(fem::make_lower_obstacle<>(3, 3), test::zeros(8)),
                       "v: got 8, expected one number for each interior node",
                       std::invalid_argument);
}

}  // namespace membrane_test
