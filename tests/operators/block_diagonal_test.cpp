// SPDX-License-Identifier: MIT
#include <slant/factorizations/dense_ldlt.hpp>
#include <slant/operators/operators.hpp>
#include <slant/testing/archetypes.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>
#include "operators/dense_oracle.hpp"

namespace block_diagonal_test {

namespace archetype = slant::testing::archetype;

TEST_CASE("a block diagonal matrix") {
  MatrixXd const m = test::random_dense(3, 3, 1);
  auto const s = test::random_sparse(4, 4, 2);
  auto const a = slant::block_diagonal(m, slant::zero(2), s);
  MatrixXd expected = MatrixXd::Zero(9, 9);
  expected.topLeftCorner(3, 3) = m;
  expected.bottomRightCorner(4, 4) = s;
  CHECK(test::matches(a, expected));
  static_assert(slant::has_accumulate<decltype(a), VectorXd>);
  static_assert(slant::has_adjoint_accumulate<decltype(a), VectorXd>);
  static_assert(slant::has_diagonal<decltype(a), VectorXd>);
  static_assert(slant::has_columns<decltype(a), MatrixXd>);
  static_assert(!slant::has_inverse<decltype(a), VectorXd>);
  slant::testing::check_operator_laws(a);
  slant::testing::check_operator_laws(
      slant::block_diagonal(test::random_dense(2, 3, 3), test::random_dense(3, 1, 4)));
}

TEST_CASE("closure: what all blocks promise") {
  using namespace slant;
  MatrixXd const m = test::random_spd(3, 5);
  auto const definite = matrix<self_adjoint, positive_definite>(m);
  auto const p = slant::diagonal<projector>(VectorXd(VectorXd::Unit(3, 1)));
  auto const a = block_diagonal(definite, identity(2));
  static_assert(laws_of<decltype(a)> == laws<law::self_adjoint, law::positive_definite>);
  testing::check_operator_laws(a);
  auto const b = block_diagonal(p, identity(2), zero(2));
  static_assert(laws_of<decltype(b)> == laws<law::self_adjoint, law::projector>);
  testing::check_operator_laws(b);
  static_assert(laws_of<decltype(block_diagonal(matrix(m), identity(2)))> == law_set{});
}

TEST_CASE("the inverse is block diagonal") {
  auto const d = slant::diagonal<slant::positive_definite>(VectorXd(VectorXd::LinSpaced(3, 1, 4)));
  auto const a = slant::block_diagonal(d, slant::identity(2));
  static_assert(slant::has_inverse<decltype(a), VectorXd>);
  slant::testing::check_operator_laws(a);
  auto const K = slant::op<"K">(slant::dense_ldlt<double>(test::random_spd(3, 5)));
  using inverses = decltype(slant::block_diagonal(slant::inverse(K), slant::inverse(K)));
  static_assert(!slant::has_inverse<inverses, VectorXd>);  // K is a name, no operator
}

TEST_CASE("parts that know only their own vector type work on copies") {
  archetype::linear_operator const part(test::random_dense(3, 3, 6));
  auto const a = slant::block_diagonal(part, slant::identity(2), part);
  archetype::vector const x(test::random_column(8, 7));
  static_assert(!slant::has_adjoint<decltype(a), archetype::vector>);
  static_assert(!slant::has_accumulate<decltype(a), archetype::vector>);
  slant::testing::check_operator_laws(a, x);
}

TEST_CASE("any number of blocks of one type and different sizes, as a dense matrix") {
  std::vector<decltype(slant::matrix(MatrixXd()))> blocks;
  MatrixXd whole = MatrixXd::Zero(6, 7);
  for (auto const& [row, col, rows, cols] :
       {std::array{0, 0, 2, 3}, std::array{2, 3, 1, 1}, std::array{3, 4, 3, 3}}) {
    blocks.push_back(slant::matrix(test::random_dense(rows, cols, unsigned(row))));
    whole.block(row, col, rows, cols) = blocks.back().get();
  }
  auto const a = slant::diagonal_blocks(blocks);
  CHECK(a.block_count() == 3);
  CHECK(test::matches(a, whole, 0));
  static_assert(slant::has_adjoint<decltype(a), VectorXd>);
  slant::testing::check_operator_laws(a);
  CHECK(slant::diagonal_blocks(std::vector<decltype(slant::matrix(MatrixXd()))>{}).rows() == 0);
}

TEST_CASE("any number of blocks: laws are those of the blocks; no allocation") {
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

/// By its definition.
MatrixXd kronecker(MatrixXd const& a, MatrixXd const& b) {
  MatrixXd k(a.rows() * b.rows(), a.cols() * b.cols());
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    for (Eigen::Index j = 0; j < a.cols(); ++j)
      k.block(i * b.rows(), j * b.cols(), b.rows(), b.cols()) = a(i, j) * b;
  }
  return k;
}

TEST_CASE("A ⊗ B is what its definition says, and so is its adjoint") {
  MatrixXd const a = test::random_dense(2, 3, 1), b = test::random_dense(4, 5, 2);
  auto const k = slant::kronecker(a, b);
  CHECK(k.rows() == 8);
  CHECK(k.cols() == 15);
  CHECK(test::matches(k, kronecker(a, b)));
  VectorXd d(6);  // of a square product of factors that are not
  CHECK_THROWS_AS(slant::kronecker(a, MatrixXd(a.transpose())).diagonal(d), slant::bad_input);
  slant::testing::check_operator_laws(k);
  VectorXd const x = test::random_column(15, 3);
  VectorXd y(8);
  auto w = slant::workspace(k, x);
  CHECK(test::allocations_of([&] { slant::apply(k, x, y, w); }) == 0);
}

TEST_CASE("laws of self-adjoint factors, diagonal, inverse") {
  using namespace slant;
  MatrixXd const m = test::random_spd(3, 1), n = test::random_spd(2, 2);
  auto const a = matrix<self_adjoint, positive_definite>(m);
  auto const b = matrix<self_adjoint, positive_definite>(n);
  auto const k = kronecker(a, b);
  static_assert(spd_operator<decltype(k), VectorXd>);
  CHECK(test::matches(k, block_diagonal_test::kronecker(m, n)));
  testing::check_operator_laws(k);
  // Definite, not self-adjoint: (A ⊗ A) of a rotation by 90° is not definite.
  static_assert(
      laws_of<decltype(kronecker(matrix<positive_definite>(m), matrix<positive_definite>(n)))> ==
      law_set{});
  auto const d = kronecker(identity(2), diagonal<positive_definite>(VectorXd{{1.0, 4.0}}));
  static_assert(has_inverse<decltype(d), VectorXd>);
  CHECK(test::matches(d.inverse(), MatrixXd(VectorXd{{1.0, 0.25, 1.0, 0.25}}.asDiagonal())));
  testing::check_operator_laws(d);
}

}  // namespace block_diagonal_test
