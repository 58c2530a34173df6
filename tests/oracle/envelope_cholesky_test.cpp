// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <Eigen/LU>
#include <oracle/envelope_cholesky.hpp>

namespace envelope_cholesky_test {

// Irregular envelope: some rows begin at the first column, some at the diagonal.
Eigen::SparseMatrix<double> arrow_and_band(Eigen::Index n) {
  Eigen::SparseMatrix<double> K(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    K.coeffRef(i, i) = 10.0 + static_cast<double>(i % 3);
    if (i % 5 == 4) K.coeffRef(i, 0) = K.coeffRef(0, i) = 0.5;
    if (i % 4 == 3) K.coeffRef(i, i - 2) = K.coeffRef(i - 2, i) = -1.25;
  }
  return K;
}

TEST_CASE("envelope_cholesky solves") {
  auto const K = arrow_and_band(23);
  Eigen::VectorXd const x = Eigen::VectorXd::LinSpaced(23, -1, 2);
  oracle::envelope_cholesky const L(K);
  CHECK((L.solve(K * x) - x).norm() <= 1e-14 * x.norm());
}

TEST_CASE("forward is the inverse of a triangular factor of K") {
  auto const K = arrow_and_band(17);
  oracle::envelope_cholesky::row_major Y = Eigen::MatrixXd::Identity(17, 17);
  oracle::envelope_cholesky(K).forward(Y);
  CHECK(Y.isLowerTriangular());
  Eigen::MatrixXd const product = Y.transpose() * Y * Eigen::MatrixXd(K);
  CHECK((product - Eigen::MatrixXd::Identity(17, 17)).norm() < 1e-14);
}

TEST_CASE("envelope_cholesky refuses indefinite, singular and NaN matrices") {
  auto K = arrow_and_band(9);
  K.coeffRef(6, 6) = -1;
  CHECK_THROWS_AS(oracle::envelope_cholesky{K}, std::runtime_error);
  K.coeffRef(6, 6) = std::nan("");
  CHECK_THROWS_AS(oracle::envelope_cholesky{K}, std::runtime_error);
  Eigen::SparseMatrix<double> const zero(3, 3);
  CHECK_THROWS_AS(oracle::envelope_cholesky{zero}, std::runtime_error);
}

}  // namespace envelope_cholesky_test
