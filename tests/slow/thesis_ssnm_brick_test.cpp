// SPDX-License-Identifier: MIT
#include <slant/newton/saddle_solvers.hpp>

#include <fem/thesis_ssnm_brick.hpp>
#include <oracle/dense_newton.hpp>
#include <support/testing.hpp>

namespace thesis_ssnm_brick_test {

TEST_CASE("the dual problem of a brick, with its dense A") {
  auto const scene = fem::make_steel_brick({.k = 3, .load = fem::brick_load::pull});
  fem::dense_dual_brick const brick(scene);
  auto const m = scene.d.size();
  oracle::dense_qp dense{brick.A, brick.b.cast<oracle::real>()};
  for (Eigen::Index i = 0; i < m; ++i) dense.intervals.push_back({i, 0.0});
  for (Eigen::Index i = 0; i < m; ++i) {
    dense.circles.push_back({m + 2 * i, m + 2 * i + 1, scene.g[i]});
  }
  VectorXd const exact = oracle::solve_dense(dense).x.cast<double>();
  auto const c = fem::run_brick_ssnm(brick, slant::schur_cg{}, fem::thesis_options(1, 0.1, 0.2));
  auto const a =
      fem::run_brick_ssnm(brick, slant::schur_bicgstab{}, fem::thesis_options(1, 0.2, 0.4));
  // Strategy B, BiCGSTAB on the whole saddle point system, stagnates or not by the last digit of b.
  for (auto const& r : {c, a}) {
    CHECK(r.converged());
    CHECK((r.x - exact).norm() <= 1e-3 * exact.norm());
  }
  CHECK(c.products < a.products);
}

}  // namespace thesis_ssnm_brick_test
