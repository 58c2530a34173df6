// SPDX-License-Identifier: MIT
#include "newton_scene.hpp"

#include <slant/newton/direct_solver.hpp>
#include <slant/operators/diagonal.hpp>

#include <doctest/doctest.h>

namespace direct_solver_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

template <class Solver, class G>
slant::direction_report<double> solve_twice(Solver const& solver, G const& g, VectorXd const& f,
                                            VectorXd& dy) {
  auto p = solver.prepare(g, f);
  auto q = p;  // states are copied, factors included or not
  static_cast<void>(solver.solve(g, f, {0, f.norm(), 0}, dy, p));
  return solver.solve(g, f, {0, f.norm(), 0}, dy, q);
}

TEST_CASE("a matrix, columns, an inverse: the same direction") {
  MatrixXd m = slanting_support::random_spd(12, 1) + slanting_support::random_matrix(12, 12, 2);
  VectorXd const f = slanting_support::random_vector(12, 3);
  VectorXd const exact = slanting_support::solve(m, VectorXd(-f));
  VectorXd dy(12);
  auto const check = [&](auto const& solver, auto const& g) {
    auto const r = solve_twice(solver, g, f, dy);
    CHECK(r.factorizations == 1);
    CHECK(r.iterations == 0);
    CHECK(r.residual_norm <= 1e-13 * f.norm());
    CHECK(r.status != slant::status::breakdown);
    CHECK((dy - exact).norm() <= 1e-12 * exact.norm());
  };
  check(slant::direct_solver{}, slant::matrix(m));
  check(slant::direct_solver{}, slant::counted(m));

  VectorXd const d = VectorXd::LinSpaced(12, 1, 7);
  auto const D = slant::diagonal<slant::self_adjoint, slant::positive_definite>(d);
  auto const r = solve_twice(slant::direct_solver{}, D, f, dy);
  CHECK(r.factorizations == 0);
  CHECK(r.operator_applications == 2);
  CHECK((dy + f.cwiseQuotient(d)).norm() <= 1e-15);
}

TEST_CASE("a natural residual by its columns: no product is spent on the residual") {
  newton_scene::data const d(15);
  auto const A = slant::counted(d.definite());
  auto const F = slant::natural_residual(A, d.b, newton_scene::contact_set(15, 1e-3), d.ρ);
  VectorXd const x = slanting_support::random_vector(45, 7);
  VectorXd const f = slant::evaluate(F, x);
  auto const G = F.slant(x);
  VectorXd const exact = slanting_support::solve(slanting_support::dense(G, x), VectorXd(-f));
  VectorXd dy(45);
  A.reset_counts();
  slant::direct_solver const dense;
  auto p = dense.prepare(G, f);
  CHECK(dense.solve(G, f, {0, f.norm(), 0}, dy, p).operator_applications == 0);
  CHECK(A.counts().columns == 45);
  CHECK(A.applications() == 0);
  CHECK((dy - exact).norm() <= 1e-11 * exact.norm());
}

TEST_CASE("singular matrices, and those that are not numbers, are breakdowns") {
  VectorXd const f = VectorXd::Ones(3);
  VectorXd dy = VectorXd::Constant(3, std::nan(""));
  MatrixXd singular = MatrixXd::Ones(3, 3);
  MatrixXd const nan = MatrixXd::Constant(3, 3, std::nan(""));
  for (MatrixXd const& m : {MatrixXd(MatrixXd::Zero(3, 3)), singular, nan}) {
    slant::matrix_operator<MatrixXd> const g{slant::held<MatrixXd>(MatrixXd(m))};
    auto const r = solve_twice(slant::direct_solver{}, g, f, dy);
    CHECK(r.status == slant::status::breakdown);
    CHECK(r.residual_norm == f.norm());
    CHECK(dy == VectorXd::Zero(3));
  }
}

TEST_CASE("who can be solved directly, and at what price") {
  using dense = decltype(slant::matrix(MatrixXd()));
  using sparse = decltype(slant::matrix(Eigen::SparseMatrix<double>()));
  using counted = decltype(slant::counted(MatrixXd()));
  static_assert(slant::solved_cheaply<dense, VectorXd> && slant::solved_cheaply<sparse, VectorXd>);
  static_assert(slant::solved_cheaply<slant::identity_operator, VectorXd>);
  static_assert(!slant::solved_cheaply<counted, VectorXd>);
  static_assert(slant::solved_directly<counted, VectorXd>);
  static_assert(slant::direction_solver<slant::direct_solver, counted, VectorXd>);
}

}  // namespace direct_solver_test
