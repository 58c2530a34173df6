// SPDX-License-Identifier: MIT
#include <slant/factorizations/ldlt.hpp>
#include <slant/operators/operators.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>
#include "operators/dense_oracle.hpp"

namespace schur_complement_test {

using namespace test::evaluated;
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
  // Elimination of the first unknowns gives the same.
  MatrixXd whole(10, 9);
  whole << k, MatrixXd(b1.transpose()), MatrixXd(b2), -d;
  MatrixXd const eliminated =
      whole.bottomRightCorner(4, 3) -
      whole.bottomLeftCorner(4, 6) * test::solutions_of(k, whole.topRightCorner(6, 3));
  CHECK(test::matches(s, MatrixXd(-eliminated), 1000));
}

TEST_CASE("the symmetric one has the closures of sum and congruence") {
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

TEST_CASE("sizes must fit") {
  using slant::bad_input;
  MatrixXd const b = MatrixXd::Ones(2, 4);
  auto const kinv = slant::identity(4);
  CHECK(test::message<bad_input>([&] {
          (void)slant::schur_complement(slant::identity(3), b, b, slant::identity(2));
        }) == "B1: got 2 x 4, expected 3 columns (the size of K)");
  CHECK(test::message<bad_input>([&] {
          (void)slant::schur_complement(kinv, b, MatrixXd(b.transpose()), slant::identity(2));
        }) == "B2: got 4 x 2, expected 4 columns (the size of K)");
  CHECK(test::message<bad_input>([&] {
          (void)slant::schur_complement(kinv, b, b, slant::identity(3));
        }) == "D: got 3 x 3, expected 2 x 2 (the rows of B2 and of B1)");
  CHECK(test::message<bad_input>([&] {
          (void)slant::schur_complement(kinv, slant::full_row_rank(b), slant::identity(3));
        }) == "D: got 3 x 3, expected 2 x 2 (the rows of B)");
}

}  // namespace schur_complement_test
