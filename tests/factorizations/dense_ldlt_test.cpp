// SPDX-License-Identifier: MIT
#include <slant/factorizations/dense_ldlt.hpp>

#include <doctest/doctest.h>

#include "factorizations/spd_examples.hpp"
#include "support/allocation_guard.hpp"

namespace dense_ldlt_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

auto const factor = [](MatrixXd const& k) { return slant::dense_ldlt(k); };

static_assert(slant::factorization<slant::dense_ldlt<>, VectorXd>);
static_assert(slant::factorization<slant::dense_ldlt<>, MatrixXd>);
static_assert(!slant::factorization<slant::dense_ldlt<>, Eigen::VectorXf>);

TEST_CASE("solutions have small residuals, also for several right-hand sides") {
  MatrixXd k = test::grid_laplacian(3, 0.1);
  k.topLeftCorner(5, 5).array() += 0.5;  // pivots out of order
  slant::dense_ldlt const factors(k);
  CHECK(factors.name() == "dense_ldlt");
  CHECK(test::residual(factors, k) < 1e-14);
  MatrixXd b(k.rows(), 2);
  b << test::load(k.rows()), VectorXd::Unit(k.rows(), 7);
  MatrixXd x(k.rows(), 2);
  factors.solve(b, x);
  CHECK((k * x - b).norm() < 1e-13 * b.norm());
}

TEST_CASE_TEMPLATE("other scalars", S, float, long double) {
  using matrix = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;
  matrix const k = test::grid_laplacian<S>(3, 0.1);
  CHECK(test::residual(slant::dense_ldlt(k), k) < S(100) * std::numeric_limits<S>::epsilon());
}

TEST_CASE("sizes of a solve") {
  test::check_sizes_of_solve(slant::dense_ldlt(MatrixXd(test::grid_laplacian(3, 0.1))));
}

TEST_CASE("units do not matter") {
  test::check_units(factor, MatrixXd(test::grid_laplacian(3, 0.1)));
}

TEST_CASE("complaints name the entry or the pivot") {
  test::check_complaints(factor, MatrixXd(test::grid_laplacian(3, 0.1)),
                         MatrixXd(test::grid_laplacian(3, 0)));
  MatrixXd small(3, 3);
  small << 1, 0, 0, 0, 4, 5, 0, 5, 6;  // the pivot of row 2 comes first: 4 − 25/6 < 0 in row 1
  CHECK(test::complaint(factor, small).rfind("K: got pivot 1 (row 0) = 1", 0) != 0);
  CHECK(test::contains(test::complaint(factor, small), "(row 1) = -0.1666"));
}

TEST_CASE("a solve allocates nothing; the empty matrix") {
  MatrixXd const k = test::grid_laplacian(3, 0.1);
  auto const a = slant::inverse(slant::dense_ldlt(k));
  VectorXd const b = test::load(k.rows());
  VectorXd x(k.rows());
  auto w = slant::workspace(a, b);
  slant::testing::allocation_guard guard;
  slant::apply(a, b, x, w);
  auto const allocations = guard.count();
  CHECK(allocations == 0);
  CHECK(slant::dense_ldlt(MatrixXd(0, 0)).rows() == 0);
}

}  // namespace dense_ldlt_test
