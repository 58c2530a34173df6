// SPDX-License-Identifier: MIT
#include <slant/factorizations/fill_estimate.hpp>

#include <fem/steel_brick.hpp>

#include <doctest/doctest.h>

#include <Eigen/SparseCholesky>

namespace fill_estimate_test {

using sparse = Eigen::SparseMatrix<double>;

TEST_CASE("a full matrix fills completely: n(n + 1)/2 entries, n³/3 operations") {
  sparse const full = Eigen::MatrixXd::Ones(24, 24).sparseView();
  auto const e = slant::estimate_fill(full);
  CHECK(e.entries == 24 * 25 / 2);
  CHECK(e.operations == doctest::Approx(24. * 24 * 24 / 3).epsilon(0.1));
  CHECK(e.complete);
}

TEST_CASE("the entries are those of Eigen's factor with the same kind of ordering") {
  sparse const K = fem::make_steel_brick({.k = 3}).K;
  Eigen::SimplicialLLT<sparse> const factor(K);
  auto const entries = double(sparse(factor.matrixL()).nonZeros());
  auto const e = slant::estimate_fill(K);
  // Nodes are ordered instead of unknowns: not the same, but as good.
  CHECK(e.entries >= 0.8 * entries);
  CHECK(e.entries <= 1.2 * entries);
}

TEST_CASE("counting stops where enough is known; nothing to factor, nothing to count") {
  sparse const K = fem::make_steel_brick({.k = 3}).K;
  double const all = slant::estimate_fill(K).operations;
  auto const e = slant::estimate_fill(K, all / 10);
  CHECK(!e.complete);
  CHECK(e.operations > all / 10);
  CHECK(e.operations < all);
  CHECK(slant::estimate_fill(sparse(0, 0)).operations == 0);
  CHECK_THROWS_WITH_AS((void)slant::estimate_fill(sparse(2, 3)),
                       "columns of K: got 3, expected rows of K, 2", slant::bad_input);
}

}  // namespace fill_estimate_test
