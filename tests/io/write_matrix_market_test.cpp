// SPDX-License-Identifier: MIT
//
// Writing Matrix Market files: the same bits come back.
#include <doctest/doctest.h>

#include <bit>
#include <cstdint>
#include <limits>
#include <random>
#include <slant/io/matrix_market.hpp>
#include <string>
#include <vector>

#include "io_support.hpp"
#include "support/message.hpp"

namespace write_matrix_market_test {

using io_test::get;
using io_test::temporary_folder;
using test::complaint;

/// Any finite double, from the smallest to the largest.
template <class Random>
double any_finite(Random& random) {
  for (;;)
    if (auto const x = std::bit_cast<double>(std::uint64_t{random()}); std::isfinite(x)) return x;
}

template <class Matrix>
Matrix random_matrix(int rows, int cols, int entries, unsigned seed) {
  std::mt19937_64 random(seed);
  std::vector<Eigen::Triplet<double>> triplets;
  for (int k = 0; k < entries; ++k)
    triplets.emplace_back(static_cast<int>(random() % static_cast<unsigned>(rows)),
                          static_cast<int>(random() % static_cast<unsigned>(cols)),
                          any_finite(random));
  Matrix A(rows, cols);
  A.setFromTriplets(triplets.begin(), triplets.end(), [](double, double b) { return b; });
  return A;
}

/// Same pattern, same bits.
bool identical(Eigen::SparseMatrix<double> const& a, Eigen::SparseMatrix<double> const& b) {
  if (a.rows() != b.rows() || a.cols() != b.cols() || a.nonZeros() != b.nonZeros()) return false;
  for (int col = 0; col < a.cols(); ++col) {
    Eigen::SparseMatrix<double>::InnerIterator x(a, col), y(b, col);
    for (; x && y; ++x, ++y)
      if (x.row() != y.row() ||
          std::bit_cast<std::uint64_t>(x.value()) != std::bit_cast<std::uint64_t>(y.value()))
        return false;
    if (x || y) return false;
  }
  return true;
}

TEST_CASE("write matrix market: the text") {
  temporary_folder const folder;
  Eigen::SparseMatrix<double> A(2, 2);
  A.insert(0, 0) = 0.1;
  A.insert(1, 0) = -3;
  A.insert(0, 1) = -3;
  slant::write_matrix_market(folder / "A.mtx", A);
  CHECK(get(folder / "A.mtx") ==
        "%%MatrixMarket matrix coordinate real general\n2 2 3\n1 1 0.1\n2 1 -3\n1 2 -3\n");
  slant::write_matrix_market(folder / "A.mtx", A, slant::matrix_market_symmetry::symmetric);
  CHECK(get(folder / "A.mtx") ==
        "%%MatrixMarket matrix coordinate real symmetric\n2 2 2\n1 1 0.1\n2 1 -3\n");
}

TEST_CASE("write matrix market: general matrices come back bit by bit") {
  temporary_folder const folder;
  using column_major = Eigen::SparseMatrix<double>;
  using row_major = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  auto const A = random_matrix<column_major>(70, 90, 2000, 1);
  slant::write_matrix_market(folder / "A.mtx", A);
  CHECK(identical(slant::read_matrix_market(folder / "A.mtx"), A));
  auto const R = random_matrix<row_major>(30, 20, 200, 2);
  slant::write_matrix_market(folder / "R.mtx", R);
  CHECK(identical(slant::read_matrix_market(folder / "R.mtx"), column_major(R)));
  column_major const empty(3, 5);
  slant::write_matrix_market(folder / "E.mtx", empty);
  CHECK(identical(slant::read_matrix_market(folder / "E.mtx"), empty));
  slant::write_matrix_market(folder / "H.mtx", A.topRows(0));
  CHECK(slant::read_matrix_market(folder / "H.mtx").rows() == 0);
}

TEST_CASE("write matrix market: symmetric matrices come back bit by bit") {
  temporary_folder const folder;
  auto const lower = random_matrix<Eigen::SparseMatrix<double>>(60, 60, 900, 3);
  Eigen::SparseMatrix<double> const A = lower.selfadjointView<Eigen::Lower>();
  slant::write_matrix_market(folder / "A.mtx", A, slant::matrix_market_symmetry::symmetric);
  CHECK(identical(slant::read_matrix_market(folder / "A.mtx"), A));
}

TEST_CASE("write matrix market: other scalars") {
  temporary_folder const folder;
  Eigen::SparseMatrix<long double> A(1, 1);
  A.insert(0, 0) = 1 / 3.0L;
  slant::write_matrix_market(folder / "A.mtx", A);
  CHECK(slant::read_matrix_market<long double>(folder / "A.mtx").coeff(0, 0) == 1 / 3.0L);
  Eigen::SparseMatrix<float> B(1, 1);
  B.insert(0, 0) = 0.1f;
  slant::write_matrix_market(folder / "B.mtx", B);
  CHECK(slant::read_matrix_market<float>(folder / "B.mtx").coeff(0, 0) == 0.1f);
}

TEST_CASE("write matrix market: what is not written, and that nothing is left of it") {
  temporary_folder const folder;
  std::string const name = (folder / "A.mtx").string();
  Eigen::SparseMatrix<double> A(2, 2);
  A.insert(1, 0) = std::numeric_limits<double>::quiet_NaN();
  CHECK(complaint([&] { slant::write_matrix_market(folder / "A.mtx", A); }) ==
        name + ": got nan in row 2, column 1, expected finite entries");
  A.coeffRef(1, 0) = 2.5;
  A.insert(0, 1) = 2;
  auto const symmetric = slant::matrix_market_symmetry::symmetric;
  CHECK(complaint([&] { slant::write_matrix_market(folder / "A.mtx", A, symmetric); }) ==
        name +
            ": got 2.5 in row 2, column 1 and 2 in its mirror image, expected equal entries, since "
            "it is to be stored as symmetric");
  Eigen::SparseMatrix<double> const wide(2, 3);
  CHECK(complaint([&] { slant::write_matrix_market(folder / "A.mtx", wide, symmetric); }) ==
        name +
            ": got 2 rows and 3 columns, expected a square matrix, since it is to be stored as "
            "symmetric");
  CHECK(folder.entries() == 0);
}

}  // namespace write_matrix_market_test
