// SPDX-License-Identifier: MIT
#include <slant/factorizations/ldlt.hpp>
#include <slant/operators/operators.hpp>
#include <slant/testing/archetypes.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>
#include "operators/dense_oracle.hpp"

namespace congruence_test {

using namespace test::evaluated;
namespace archetype = slant::testing::archetype;

TEST_CASE("the congruence is B A Bᵀ") {
  auto const b = test::random_sparse(3, 6, 1);
  MatrixXd const k = test::random_spd(6, 2);
  auto const a = slant::congruence(b, slant::inverse(slant::ldlt(k.sparseView())));
  CHECK(test::matches(a, MatrixXd(b * k.inverse() * b.transpose()), 1000));
  static_assert(slant::psd_operator<decltype(a), VectorXd>);
  static_assert(!slant::spd_operator<decltype(a), VectorXd>);
  static_assert(slant::has_accumulate<decltype(a), VectorXd>);
  static_assert(slant::applies_to_many<decltype(a), MatrixXd>);
  slant::testing::check_operator_laws(a, {.roundings = 1000});

  MatrixXd const m = test::random_dense(6, 6, 3);
  auto const nonsymmetric = slant::congruence(b, m);
  static_assert(slant::laws_of<decltype(nonsymmetric)> == slant::law_set{});
  CHECK(test::matches(nonsymmetric, MatrixXd(b * m * b.transpose())));
  slant::testing::check_operator_laws(nonsymmetric);
}

TEST_CASE("closure: definite if the rows of B are asserted to be independent") {
  using namespace slant;
  auto const b = test::random_sparse(3, 6, 4);
  MatrixXd const m = test::random_spd(6, 5);
  auto const definite = matrix<self_adjoint, positive_definite>(m);
  auto const a = congruence(full_row_rank(b), definite);
  static_assert(spd_operator<decltype(a), VectorXd>);
  testing::check_operator_laws(a);
  CHECK(test::matches(a, MatrixXd(b * m * b.transpose())));

  static_assert(laws_of<decltype(congruence(b, definite))> ==
                laws<law::self_adjoint, law::positive_semidefinite>);
  static_assert(laws_of<decltype(congruence(full_row_rank(b), matrix<self_adjoint>(m)))> ==
                laws<law::self_adjoint>);
  static_assert(laws_of<decltype(congruence(full_row_rank(b),
                                            matrix<self_adjoint, positive_semidefinite>(m)))> ==
                laws<law::self_adjoint, law::positive_semidefinite>);
  // B Bᵀ is no projector.
  static_assert(laws_of<decltype(congruence(b, identity(6)))> ==
                laws<law::self_adjoint, law::positive_semidefinite>);
  // A wrong assertion is found by the law check.
  MatrixXd dependent = test::random_dense(3, 6, 6);
  dependent.row(2) = dependent.row(0) + dependent.row(1);
  CHECK(!testing::operator_breaches(congruence(full_row_rank(dependent), definite)).empty());
}

TEST_CASE("archetypes") {
  MatrixXd const m = test::random_dense(4, 4, 7);
  archetype::operator_with_adjoint const b(m);
  archetype::vector const x(test::random_column(4, 8));
  auto const a = slant::congruence(b, archetype::linear_operator(m));
  static_assert(!slant::has_accumulate<decltype(a), archetype::vector>);
  static_assert(!slant::has_adjoint<decltype(a), archetype::vector>);
  slant::testing::check_operator_laws(a, x);
  auto const s =
      slant::congruence(b, slant::inverse(archetype::spd_factorization(test::random_spd(4, 9))));
  static_assert(slant::psd_operator<decltype(s), archetype::vector>);
  slant::testing::check_operator_laws(s, x, {.roundings = 1000});
}

TEST_CASE("sizes must fit") {
  MatrixXd const b = MatrixXd::Ones(2, 3);
  CHECK(SLANT_COMPLAINT(slant::congruence(b, slant::identity(2))) ==
        "B: got 2 x 3, expected 2 columns (the size of A)");
  CHECK(SLANT_COMPLAINT(slant::congruence(b, b)) == "A: got 2 x 3, expected a square operator");
}

}  // namespace congruence_test
