// SPDX-License-Identifier: MIT
#include "newton_scene.hpp"

#include <slant/newton/direct_solver.hpp>

#include <doctest/doctest.h>

#include <utility>

namespace sparse_direct_solver_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using sparse_matrix = Eigen::SparseMatrix<double>;

template <class Solver, class G>
slant::direction_report<double> solve_twice(Solver const& solver, G const& g, VectorXd const& f,
                                            VectorXd& dy) {
  auto p = solver.prepare(g, f);
  auto q = p;  // states are copied; the factors stay behind
  static_cast<void>(solver.solve(g, f, {0, f.norm(), 0}, dy, p));
  return solver.solve(g, f, {0, f.norm(), 0}, dy, q);
}

TEST_CASE("sparse matrices of both orders, and columns of a composition") {
  newton_scene::data const d(15);
  auto const A = slant::counted(d.definite());
  auto const F = slant::natural_residual(A, d.b, newton_scene::contact_set(15, 1e-3), d.ρ);
  VectorXd const x = slanting_support::random_vector(45, 7);
  VectorXd const f = slant::evaluate(F, x);
  auto const G = F.slant(x);
  MatrixXd const dense = slanting_support::dense(G, x);
  VectorXd const exact = slanting_support::solve(dense, VectorXd(-f));
  sparse_matrix const by_columns = dense.sparseView();
  Eigen::SparseMatrix<double, Eigen::RowMajor> const by_rows = by_columns;
  VectorXd dy(45);
  auto const check = [&](slant::direction_report<double> const& r) {
    CHECK(r.factorizations == 1);
    CHECK(r.residual_norm <= 1e-13 * f.norm());
    CHECK((dy - exact).norm() <= 1e-11 * exact.norm());
  };
  A.reset_counts();
  check(solve_twice(slant::sparse_direct_solver{}, G, f, dy));  // 32 columns and 13
  CHECK(A.applications() == 0);
  check(solve_twice(slant::direct_solver{}, slant::matrix(by_columns), f, dy));
  auto const linear = slant::linear(by_rows);
  check(solve_twice(slant::direct_solver{}, linear.slant(x), f, dy));
}

TEST_CASE("singular matrices, and those that are not numbers, are breakdowns") {
  // Eigen's sparse LU by itself does not come back from 51 columns without entries.
  using pair = std::pair<Eigen::Index, double>;
  for (auto const& [n, entry] :
       {pair{3, 0.0}, pair{3, 1.0}, pair{3, std::nan("")}, pair{51, 0.0}}) {
    VectorXd const f = VectorXd::Ones(n);
    VectorXd dy(n);
    sparse_matrix m = MatrixXd(MatrixXd::Constant(n, n, entry)).sparseView();
    slant::matrix_operator<sparse_matrix> const g{slant::held<sparse_matrix>(std::move(m))};
    CAPTURE(n);
    CAPTURE(entry);
    for (auto const& r : {solve_twice(slant::direct_solver{}, g, f, dy),
                          solve_twice(slant::sparse_direct_solver{}, g, f, dy)}) {
      CHECK(r.status == slant::status::breakdown);
      CHECK(r.residual_norm == f.norm());
      CHECK(dy == VectorXd::Zero(n));
    }
  }
}

}  // namespace sparse_direct_solver_test
