// SPDX-License-Identifier: MIT
#include <slant/operators/operators.hpp>
#include <slant/testing/laws.hpp>

#include <support/dense_of.hpp>
#include <support/testing.hpp>

namespace diagonal_blocks_test {

MatrixXd numbers(Eigen::Index rows, Eigen::Index cols) {
  return MatrixXd::NullaryExpr(rows, cols, [](auto i, auto j) {
    return 1.0 + 3.0 * static_cast<double>(i) - 2.0 * static_cast<double>(j * j);
  });
}

TEST_CASE("blocks of different sizes, as a dense matrix") {
  std::vector<decltype(slant::matrix(MatrixXd()))> blocks;
  MatrixXd whole = MatrixXd::Zero(6, 7);
  for (auto const& [row, col, rows, cols] :
       {std::array{0, 0, 2, 3}, std::array{2, 3, 1, 1}, std::array{3, 4, 3, 3}}) {
    blocks.push_back(slant::matrix(numbers(rows, cols)));
    whole.block(row, col, rows, cols) = numbers(rows, cols);
  }
  auto const a = slant::diagonal_blocks(blocks);
  CHECK(a.block_count() == 3);
  CHECK(test::dense_of(a) == whole);
  CHECK(test::dense_of(slant::adjoint(a)) == whole.transpose());
  slant::testing::check_operator_laws(a);
  CHECK(slant::diagonal_blocks(std::vector<decltype(slant::matrix(MatrixXd()))>{}).rows() == 0);
}

TEST_CASE("laws are those of the blocks; no allocation") {
  auto const block = [](double c) {
    return slant::matrix<slant::self_adjoint, slant::positive_definite>(
        MatrixXd(MatrixXd::Identity(3, 3) * c + MatrixXd::Ones(3, 3)));
  };
  auto const a = slant::diagonal_blocks(std::vector{block(1), block(2)});
  static_assert(slant::spd_operator<decltype(a), VectorXd>);
  slant::testing::check_operator_laws(a);
  VectorXd const x = VectorXd::Ones(6);
  VectorXd y(6);
  auto w = slant::workspace(a, x);
  CHECK(test::allocations_of([&] { a.apply(x, y, w); }) == 0);
}

}  // namespace diagonal_blocks_test
