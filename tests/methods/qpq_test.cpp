// SPDX-License-Identifier: MIT
#include "mixture.hpp"

#include <slant/iteration/solve.hpp>
#include <slant/methods/kprgp.hpp>
#include <slant/operators/counted.hpp>

#include <doctest/doctest.h>

#include <oracle/dense_newton.hpp>

namespace qpq_test {

using Eigen::VectorXd;

TEST_CASE("bounds and intervals only: to the last digits, agreeing with dense Newton") {
  auto const M = test::with_spectrum(test::log_spaced(20, 100));
  VectorXd const b = 3 * test::random_vector(20, 5);
  auto const A = test::spd(M);
  auto const set = slant::cartesian(slant::half_lines(10), slant::intervals(VectorXd{{0.1, 1e-3}}),
                                    slant::free_components(8));
  oracle::dense_qp plain{M, b.cast<long double>(), {}, {}};
  for (Eigen::Index i = 0; i < 10; ++i) plain.intervals.push_back({i, 0});
  plain.intervals.push_back({10, -0.1, 0.1});
  plain.intervals.push_back({11, -1e-3, 1e-3});
  auto const reference = oracle::solve_dense(plain);
  auto const counting = slant::counted(A);
  auto const qp = slant::separable_qp{counting, b, set};
  auto const r = slant::solve(slant::qpq{qp}, VectorXd(VectorXd::Zero(20)),
                              slant::reduced_gradient_below(1e-12) || slant::at_most(1000));
  REQUIRE(r.converged());
  CHECK((r.x() - reference.x.cast<double>()).norm() <= 1e-10 * r.x().norm());
  CHECK(counting.applications() ==
        r.state.work.operator_applications + r.state.work.setup_applications);
}

}  // namespace qpq_test
