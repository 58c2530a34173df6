// SPDX-License-Identifier: MIT
//
// Newton systems by factorisation: dense and sparse matrices, columns, inverses.
#include <slant/newton/direct_solver.hpp>
#include <slant/operators/diagonal.hpp>

#include <support/testing.hpp>
#include "newton_scene.hpp"

namespace direct_solver_test {

using slant::direct_solver;
using slant::sparse_direct_solver;
using sparse_matrix = Eigen::SparseMatrix<double>;

template <class Solver, class G>
slant::direction_report<double> solve_twice(Solver const& solver, G const& g, VectorXd const& f,
                                            VectorXd& dy) {
  auto p = solver.prepare(g, f);
  auto q = p;  // states are copied, factors included or not
  static_cast<void>(solver.solve(g, f, {0, f.norm()}, dy, p));
  return solver.solve(g, f, {0, f.norm()}, dy, q);
}

/// One factorisation, and the direction of a dense solve.
template <class Solver, class G>
void check(Solver const& solver, G const& g, VectorXd const& f, VectorXd const& exact) {
  VectorXd dy(f.size());
  auto const r = solve_twice(solver, g, f, dy);
  CHECK(r.factorizations == 1);
  CHECK(r.iterations == 0);
  CHECK(r.residual_norm <= 1e-13 * f.norm());
  CHECK(r.status != slant::status::breakdown);
  CHECK((dy - exact).norm() <= 1e-11 * exact.norm());
}

TEST_CASE("a matrix, columns, an inverse: the same direction") {
  MatrixXd const m =
      slanting_support::random_spd(12, 1) + slanting_support::random_matrix(12, 12, 2);
  VectorXd const f = slanting_support::random_vector(12, 3);
  VectorXd const exact = slanting_support::solve(m, VectorXd(-f));
  check(direct_solver{}, slant::matrix(m), f, exact);
  check(direct_solver{}, slant::counted(m), f, exact);

  VectorXd dy(12);
  VectorXd const d = VectorXd::LinSpaced(12, 1, 7);
  auto const D = slant::diagonal<slant::self_adjoint, slant::positive_definite>(d);
  auto const r = solve_twice(direct_solver{}, D, f, dy);
  CHECK(r.factorizations == 0);
  CHECK(r.operator_applications == 2);
  CHECK((dy + f.cwiseQuotient(d)).norm() <= 1e-15);
}

TEST_CASE("a natural residual by its columns, 32 and 13: no product is spent; sparse matrices") {
  newton_scene::data const d(15);
  auto const A = slant::counted(d.definite());
  auto const F = slant::natural_residual(A, d.b, newton_scene::contact_set(15, 1e-3), d.ρ);
  VectorXd const x = slanting_support::random_vector(45, 7);
  VectorXd const f = slant::evaluate(F, x);
  auto const G = F.slant(x);
  MatrixXd const dense = slanting_support::dense(G, x);
  VectorXd const exact = slanting_support::solve(dense, VectorXd(-f));
  for (bool const is_sparse : {false, true}) {
    A.reset_counts();
    if (is_sparse) {
      check(sparse_direct_solver{}, G, f, exact);
    } else {
      check(direct_solver{}, G, f, exact);
    }
    CHECK(A.counts().columns == 2 * 45);
    CHECK(A.applications() == 0);
  }
  sparse_matrix const by_columns = dense.sparseView();
  Eigen::SparseMatrix<double, Eigen::RowMajor> const by_rows = by_columns;
  check(direct_solver{}, slant::matrix(by_columns), f, exact);
  auto const linear = slant::linear(by_rows);
  check(direct_solver{}, linear.slant(x), f, exact);
}

TEST_CASE("singular matrices, and those that are not numbers, are breakdowns") {
  auto const broken = [](auto const& solver, auto const& g) {
    VectorXd const f = VectorXd::Ones(g.rows());
    VectorXd dy = VectorXd::Constant(g.rows(), std::nan(""));
    auto const r = solve_twice(solver, g, f, dy);
    CHECK(r.status == slant::status::breakdown);
    CHECK(r.residual_norm == f.norm());
    CHECK(dy == VectorXd::Zero(g.rows()));
  };
  // Eigen's sparse LU by itself does not come back from 51 columns without entries.
  using pair = std::pair<Eigen::Index, double>;
  for (auto const& [n, entry] :
       {pair{3, 0.0}, pair{3, 1.0}, pair{3, std::nan("")}, pair{51, 0.0}}) {
    CAPTURE(n);
    CAPTURE(entry);
    MatrixXd const m = MatrixXd::Constant(n, n, entry);
    broken(direct_solver{}, slant::matrix_operator<MatrixXd>{slant::held<MatrixXd>(MatrixXd(m))});
    slant::matrix_operator<sparse_matrix> const g{
        slant::held<sparse_matrix>(sparse_matrix(m.sparseView()))};
    broken(direct_solver{}, g);
    broken(sparse_direct_solver{}, g);
  }
  VectorXd const tiny{{1.0, 1e-310}};  // its inverse is no number
  broken(direct_solver{}, slant::diagonal<slant::positive_definite>(tiny));
}

}  // namespace direct_solver_test
