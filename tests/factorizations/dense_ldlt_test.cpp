// SPDX-License-Identifier: MIT
#include <slant/factorizations/dense_ldlt.hpp>
#include <slant/factorizations/factorize.hpp>

#include <support/testing.hpp>
#include "factorizations/spd_examples.hpp"

namespace dense_ldlt_test {

auto const factor = [](MatrixXd const& k) { return slant::dense_ldlt(k); };

static_assert(slant::factorization<slant::dense_ldlt<>, VectorXd>);
static_assert(slant::factorization<slant::dense_ldlt<>, MatrixXd>);
static_assert(!slant::factorization<slant::dense_ldlt<>, Eigen::VectorXf>);

TEST_CASE("solutions have small residuals") {
  MatrixXd k = test::grid_laplacian(3, 0.1);
  k.topLeftCorner(5, 5).array() += 0.5;  // pivots out of order
  slant::dense_ldlt const factors(k);
  CHECK(factors.name() == "dense_ldlt");
  CHECK(test::residual(factors, k) < 1e-14);
}

/// BᵀB + I of n rows.
template <class S>
Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic> definite(Eigen::Index n) {
  using matrix = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;
  matrix const b = matrix::NullaryExpr(
      n, n, [](Eigen::Index i, Eigen::Index j) { return S(((7 * i + 3 * j) % 11) - 5) / S(5); });
  return b.transpose() * b + matrix::Identity(n, n);
}

TEST_CASE_TEMPLATE("any size and number of right-hand sides", S, float, double, long double) {
  using matrix = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;
  for (Eigen::Index const n : {1, 2, 7, 8, 9, 16, 23, 40}) {
    matrix const k = definite<S>(n);
    slant::dense_ldlt const factors(k);
    for (Eigen::Index const m : {1, 3, 4, 9}) {
      CAPTURE(n);
      CAPTURE(m);
      matrix const exact = matrix::NullaryExpr(
          n, m, [](Eigen::Index i, Eigen::Index j) { return S((5 * i + j) % 7) - S(3); });
      matrix x(n, m);
      factors.solve(matrix(k * exact), x);
      // n² bounds ‖BᵀB‖, and so the condition.
      CHECK((x - exact).norm() <=
            S(20 * n * n) * std::numeric_limits<S>::epsilon() * (S(1) + exact.norm()));
    }
  }
}

TEST_CASE("vectors with strides: rows of a matrix, matrices by rows, maps") {
  MatrixXd const k = definite<double>(21);
  slant::dense_ldlt const factors(k);
  MatrixXd const b = MatrixXd::NullaryExpr(
      21, 5, [](Eigen::Index i, Eigen::Index j) { return double((3 * i + 5 * j) % 13) - 6; });
  MatrixXd x(21, 5);
  factors.solve(b, x);
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> by_rows(21, 5);
  factors.solve(b, by_rows);
  CHECK((by_rows - x).norm() <= 1e-13 * x.norm());
  std::vector<double> storage(3 * 21, 7.0);
  Eigen::Map<VectorXd, 0, Eigen::InnerStride<3>> strided(storage.data(), 21);
  factors.solve(VectorXd(b.col(2)), strided);
  CHECK((strided - x.col(2)).norm() <= 1e-13 * x.norm());
  CHECK(storage[1] == 7);
  CHECK(storage[5] == 7);
  auto column = x.col(4);
  VectorXd const before = column;
  factors.solve(VectorXd(b.col(4)), column);
  CHECK((x.col(4) - before).norm() <= 1e-13 * before.norm());
}

TEST_CASE("rows in units that differ by sixteen orders of magnitude") {
  MatrixXd k = definite<double>(20);
  VectorXd const units = VectorXd::NullaryExpr(
      20, [](Eigen::Index i) { return std::ldexp(1.0, int(i * 37 % 53) - 26); });
  VectorXd const exact = VectorXd::LinSpaced(20, -1, 1);
  VectorXd x(20);
  MatrixXd const scaled = units.asDiagonal() * k * units.asDiagonal();
  slant::dense_ldlt(scaled).solve(VectorXd(units.asDiagonal() * (k * exact)), x);
  CHECK((units.asDiagonal() * x - exact).norm() <= 1e-12);
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
  small << 1, 0, 0, 0, 4, 5, 0, 5, 6;
  CHECK(test::contains(test::complaint(factor, small), "pivot 2 (row 2) = -0.25"));
}

TEST_CASE("a solve allocates nothing; the empty matrix") {
  MatrixXd const k = test::grid_laplacian(3, 0.1);
  auto const a = slant::inverse(slant::dense_ldlt(k));
  VectorXd const b = test::load(k.rows());
  VectorXd x(k.rows());
  auto w = slant::workspace(a, b);
  CHECK(test::allocations_of([&] { slant::apply(a, b, x, w); }) == 0);
  CHECK(slant::dense_ldlt(MatrixXd(0, 0)).rows() == 0);
}

TEST_CASE("the best factorisation for the matrix") {
  auto const k = test::grid_laplacian(3, 0.1);
  auto const sparse_factors = slant::factorize(k);
#if defined(SLANT_HAS_CHOLMOD) && SLANT_HAS_CHOLMOD
  CHECK(sparse_factors.name() == "cholmod");
#else
  CHECK(sparse_factors.name() == "ldlt");
#endif
  CHECK(test::residual(sparse_factors, k) < 1e-14);

  MatrixXd const dense(k);
  auto const dense_factors = slant::factorize(dense);
  CHECK(dense_factors.name() == "dense_ldlt");
  CHECK(test::residual(dense_factors, dense) < 1e-14);

  auto const single = test::grid_laplacian<float>(3, 0.1);
  CHECK(slant::factorize(single).name() == "ldlt");
}

TEST_CASE("complaints are those of the factorisation") {
  auto const floating = test::grid_laplacian(3, 0);
  auto const text = test::complaint([](auto const& k) { return slant::factorize(k); }, floating);
  CHECK(test::contains(text, "K: got pivot 26"));
  CHECK(test::contains(text, "zero up to rounding"));
}

}  // namespace dense_ldlt_test
