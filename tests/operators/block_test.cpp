// SPDX-License-Identifier: MIT
#include <slant/factorizations/ldlt.hpp>
#include <slant/operators/operators.hpp>
#include <slant/testing/archetypes.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>
#include "operators/dense_oracle.hpp"

namespace block_test {

using namespace test::evaluated;
namespace archetype = slant::testing::archetype;

TEST_CASE("a saddle point matrix") {
  MatrixXd const k = test::random_spd(5, 1);
  auto const b = test::random_sparse(3, 5, 2);
  auto const a =
      slant::block(slant::block_row(k, slant::adjoint(b)), slant::block_row(b, slant::zero(3)));
  MatrixXd expected = MatrixXd::Zero(8, 8);
  expected.topLeftCorner(5, 5) = k;
  expected.topRightCorner(5, 3) = b.transpose();
  expected.bottomLeftCorner(3, 5) = b;
  CHECK(test::matches(a, expected));
  static_assert(slant::laws_of<decltype(a)> == slant::law_set{});
  static_assert(slant::has_accumulate<decltype(a), VectorXd>);
  static_assert(slant::has_adjoint_accumulate<decltype(a), VectorXd>);
  static_assert(slant::has_columns<decltype(a), MatrixXd>);
  slant::testing::check_operator_laws(a);
  slant::testing::check_operator_laws(slant::declare<slant::self_adjoint>(a));
}

TEST_CASE("rectangular, with a row and a column of zeros, and a zero first") {
  MatrixXd const m = test::random_dense(2, 3, 3);
  MatrixXd const n = test::random_dense(4, 1, 4);
  auto const a =
      slant::block(slant::block_row(slant::zero(2, 2), m, slant::zero(2, 1)),
                   slant::block_row(slant::zero(1, 2), slant::zero(1, 3), slant::zero(1)),
                   slant::block_row(slant::zero(4, 2), slant::zero(4, 3), n));
  MatrixXd expected = MatrixXd::Zero(7, 6);
  expected.block(0, 2, 2, 3) = m;
  expected.block(3, 5, 4, 1) = n;
  CHECK(test::matches(a, expected));
  slant::testing::check_operator_laws(a);
}

TEST_CASE("each block is applied once, zero blocks never") {
  MatrixXd const m = test::random_dense(2, 2, 5);
  auto const top = slant::counted(m);
  auto const bottom = slant::counted(m);
  auto const a =
      slant::block(slant::block_row(top, slant::zero(2)), slant::block_row(slant::zero(2), bottom));
  VectorXd const x = test::random_column(4, 6);
  VectorXd y(4);
  slant::apply(a, x, y);
  CHECK(top.counts().applications == 1);
  CHECK(bottom.counts().applications == 1);
  // A zero block needs no memory and no pass: the workspace of a row of zeros is empty.
  static_assert(std::is_same_v<decltype(slant::detail::part_workspace<false>(slant::zero(2), x)),
                               slant::no_workspace>);
}

TEST_CASE("parts that know only their own vector type work on copies") {
  MatrixXd const m = test::random_dense(3, 3, 7);
  archetype::operator_with_adjoint const part(m);
  auto const a = slant::block(slant::block_row(part, slant::identity(3)),
                              slant::block_row(slant::zero(3), part));
  archetype::vector const x(test::random_column(6, 8));
  archetype::vector y(VectorXd::Zero(6));
  slant::apply(a, x, y);
  CHECK((y.local().head(3) - (m * x.local().head(3) + x.local().tail(3))).norm() < 1e-14);
  CHECK((y.local().tail(3) - m * x.local().tail(3)).norm() < 1e-14);
  static_assert(!slant::has_accumulate<decltype(a), archetype::vector>);
  static_assert(!slant::linear_operator<decltype(a), VectorXd>);
  slant::testing::check_operator_laws(a, x);

  archetype::linear_operator const bare(m);
  auto const b = slant::block(slant::block_row(bare, bare));
  static_assert(slant::linear_operator<decltype(b), archetype::vector>);
  static_assert(!slant::has_adjoint<decltype(b), archetype::vector>);
}

TEST_CASE("sizes of blocks must fit") {
  using slant::bad_input;
  MatrixXd const m = MatrixXd::Ones(2, 3);
  CHECK(SLANT_COMPLAINT(
            slant::block(slant::block_row(m, slant::identity(3)), slant::block_row(m, m))) ==
        "block(0, 1): got 3 x 3, expected 2 x 3 (the first blocks of its row and column)");
  CHECK(SLANT_COMPLAINT(
            slant::block(slant::block_row(m, m), slant::block_row(m, slant::identity(2)))) ==
        "block(1, 1): got 2 x 2, expected 2 x 3 (the first blocks of its row and column)");
}

TEST_CASE("the general Schur complement, D + B₂ K⁻¹ B₁ᵀ, has no laws") {
  MatrixXd const k = test::random_spd(6, 1);
  auto const b1 = test::random_sparse(3, 6, 2);
  auto const b2 = test::random_sparse(4, 6, 3);
  MatrixXd const d = test::random_dense(4, 3, 4);
  slant::ldlt const factors(k.sparseView());
  MatrixXd const expected = d + b2 * k.inverse() * b1.transpose();
  auto const s = slant::schur_complement(factors, b1, b2, d);
  CHECK(test::matches(s, expected, 1000));
  static_assert(slant::laws_of<decltype(s)> == slant::law_set{});
  static_assert(slant::has_accumulate<decltype(s), VectorXd>);
  slant::testing::check_operator_laws(s, {.roundings = 1000});
  CHECK(test::matches(slant::schur_complement(slant::inverse(factors), b1, b2, d), expected, 1000));
}

TEST_CASE("the symmetric Schur complement has the closures of sum and congruence") {
  using namespace slant;
  MatrixXd const k = test::random_spd(6, 5);
  auto const b = test::random_sparse(3, 6, 6);
  ldlt const factors(k.sparseView());
  VectorXd const d = VectorXd::LinSpaced(3, 0, 1);
  auto const semidefinite = slant::diagonal<positive_semidefinite>(d);
  MatrixXd const expected = MatrixXd(d.asDiagonal()) + b * k.inverse() * b.transpose();

  auto const s = schur_complement(factors, b, semidefinite);
  CHECK(test::matches(s, expected, 1000));
  static_assert(laws_of<decltype(s)> == laws<law::self_adjoint, law::positive_semidefinite>);
  testing::check_operator_laws(s, {.roundings = 1000});

  auto const t = schur_complement(factors, full_row_rank(b), semidefinite);
  CHECK(test::matches(t, expected, 1000));
  static_assert(spd_operator<decltype(t), VectorXd>);
  static_assert(spd_operator<decltype(schur_complement(factors, b, identity(3))), VectorXd>);
  static_assert(
      spd_operator<decltype(schur_complement(factors, full_row_rank(b), zero(3))), VectorXd>);
  static_assert(laws_of<decltype(schur_complement(factors, b, slant::diagonal(d)))> ==
                laws<law::self_adjoint>);
}

TEST_CASE("sizes of a Schur complement must fit") {
  using slant::bad_input;
  MatrixXd const b = MatrixXd::Ones(2, 4);
  auto const kinv = slant::identity(4);
  CHECK(SLANT_COMPLAINT(slant::schur_complement(slant::identity(3), b, b, slant::identity(2))) ==
        "B1: got 2 x 4, expected 3 columns (the size of K)");
  CHECK(SLANT_COMPLAINT(
            slant::schur_complement(kinv, b, MatrixXd(b.transpose()), slant::identity(2))) ==
        "B2: got 4 x 2, expected 4 columns (the size of K)");
  CHECK(SLANT_COMPLAINT(slant::schur_complement(kinv, b, b, slant::identity(3))) ==
        "D: got 3 x 3, expected 2 x 2 (the rows of B2 and of B1)");
  CHECK(
      SLANT_COMPLAINT(slant::schur_complement(kinv, slant::full_row_rank(b), slant::identity(3))) ==
      "D: got 3 x 3, expected 2 x 2 (the rows of B)");
  CHECK(SLANT_COMPLAINT(slant::schur_complement(slant::matrix(b), MatrixXd(b.leftCols(2)),
                                                slant::identity(2))) ==
        "K: got 2 x 4, expected a square operator");
}

}  // namespace block_test
