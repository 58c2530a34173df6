// SPDX-License-Identifier: MIT
//
// Larger bricks under every load.
#include <slant/newton/saddle_solvers.hpp>
#include <slant/slant.hpp>

#include <fem/thesis_ssnm_brick.hpp>
#include <methods/brick_runs.hpp>
#include <oracle/dense_newton.hpp>
#include <support/testing.hpp>

namespace brick_test {

TEST_CASE("symmetric_newton: energy error 1e-8 within 250 products") {
  for (int const k : {6, 8})
    for (auto const load : fem::brick_loads) test::check_newton_brick(k, load, 250, 160);
}

TEST_CASE("kprgp: energy error 1e-6 within 25000 products") {
  for (int const k : {4, 6, 8}) {
    for (auto const load : fem::brick_loads) {
      test::check_brick(
          k, load, {1e-6, 25000, 1e-6}, [](auto const&, auto const& dual, auto const& watch) {
            auto const qp = dual.qp();
            auto const r =
                slant::solve(slant::kprgp{qp}, dual.zero(),
                             slant::reduced_gradient_below(1e-9) || slant::at_most(50000), watch);
            CHECK(r.state.work.operator_applications <= 25000);
            return r;
          });
    }
  }
}

/// 1/mean(diag A), from every seventh unit vector: normals and tangents alike.
template <class A>
double natural_step(A const& a) {
  VectorXd unit(a.rows()), image(a.rows());
  double sum = 0, count = 0;
  for (Eigen::Index i = 0; i < a.rows(); i += 7, ++count) {
    unit.setZero();
    unit[i] = 1;
    slant::apply(a, unit, image);
    sum += image[i];
  }
  return count / sum;
}

TEST_CASE("semismooth_newton alone, CG chosen by the laws: energy error 1e-8 within 250 products") {
  for (auto const load : fem::brick_loads) {
    test::check_brick(
        test::effort(4, 2), load, {1e-8, 250, 1e-6},
        [](auto const&, auto const& dual, auto const& watch) {
          auto const qp = dual.qp();
          // Each contact node has unknowns of its own, so the rows of B are independent.
          auto const A = slant::declare<slant::self_adjoint, slant::positive_definite>(qp.a());
          auto const F = slant::natural_residual(A, qp.b(), qp.set(), natural_step(A));
          slant::semismooth_newton const method{F};
          static_assert(std::is_same_v<typename decltype(method)::template solver_for<VectorXd>,
                                       slant::symmetrized_cg>);
          auto const r = slant::solve(method, dual.zero(),
                                      slant::residual_below(1e-10) || slant::at_most(50), watch);
          CHECK(r.state.work.operator_applications <= 250);
          return r;
        });
  }
}

TEST_CASE("the dual problem of a brick, with its dense A") {
  auto const scene = fem::make_steel_brick({.k = 3, .load = fem::brick_load::pull});
  fem::dense_dual_brick const brick(scene);
  auto const m = scene.d.size();
  oracle::dense_qp dense{brick.A, brick.b.cast<oracle::real>()};
  for (Eigen::Index i = 0; i < m; ++i) dense.intervals.push_back({i, 0.0});
  for (Eigen::Index i = 0; i < m; ++i)
    dense.circles.push_back({m + 2 * i, m + 2 * i + 1, scene.g[i]});
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

}  // namespace brick_test
