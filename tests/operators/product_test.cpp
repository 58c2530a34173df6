// SPDX-License-Identifier: MIT
#include <slant/operators/operators.hpp>
#include <slant/testing/archetypes.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>
#include "operators/dense_oracle.hpp"

namespace product_test {

using namespace test::evaluated;
namespace archetype = slant::testing::archetype;

TEST_CASE("a product is the product of the matrices") {
  auto const s = test::random_sparse(4, 6, 1);
  MatrixXd const m = test::random_dense(6, 5, 2);
  auto const a = slant::product(s, m);
  CHECK(test::matches(a, MatrixXd(s * m)));
  static_assert(slant::has_accumulate<decltype(a), VectorXd>);
  static_assert(slant::has_adjoint_accumulate<decltype(a), VectorXd>);
  static_assert(slant::has_columns<decltype(a), MatrixXd>);
  static_assert(!slant::has_diagonal<decltype(a), VectorXd>);
  slant::testing::check_operator_laws(a);

  MatrixXd const n = test::random_dense(5, 3, 3);
  CHECK(test::matches(slant::product(s, m, n), MatrixXd(s * m * n)));
}

TEST_CASE("closure: no law survives") {
  using namespace slant;
  MatrixXd const m = test::random_spd(3, 4);
  auto const definite = matrix<self_adjoint, positive_definite>(m);
  static_assert(laws_of<decltype(product(definite, definite))> == law_set{});
}

TEST_CASE("the inverse of a product is the product of the inverses, reversed") {
  auto const d = slant::diagonal<slant::positive_definite>(VectorXd(VectorXd::LinSpaced(4, 1, 5)));
  auto const e = slant::diagonal<slant::positive_definite>(VectorXd(VectorXd::LinSpaced(4, 2, 3)));
  auto const p = slant::product(d, e);
  static_assert(slant::has_inverse<decltype(p), VectorXd>);
  slant::testing::check_operator_laws(p);
}

TEST_CASE("archetypes") {
  MatrixXd const m = test::random_dense(4, 4, 5);
  archetype::linear_operator const a(m);
  archetype::operator_with_adjoint const b(m);
  archetype::vector const x(test::random_column(4, 6));
  auto const p = slant::product(a, b);
  static_assert(slant::linear_operator<decltype(p), archetype::vector>);
  static_assert(!slant::linear_operator<decltype(p), VectorXd>);
  static_assert(!slant::has_accumulate<decltype(p), archetype::vector>);
  static_assert(!slant::has_adjoint<decltype(p), archetype::vector>);
  slant::testing::check_operator_laws(p, x);
  auto const q = slant::product(b, b);
  static_assert(slant::has_adjoint<decltype(q), archetype::vector>);
  slant::testing::check_operator_laws(q, x);
  // apply_add needs only that of the outer part
  auto const r = slant::product(slant::slice(4, 0, 4), a);
  static_assert(slant::has_accumulate<decltype(r), archetype::vector>);
  slant::testing::check_operator_laws(r, x);
}

TEST_CASE("sizes must fit") {
  CHECK(test::message<slant::bad_input>([] {
          (void)slant::product(MatrixXd(MatrixXd::Ones(3, 2)), slant::identity(3));
        }) == "B: got 3 x 3, expected 2 rows (the columns of A)");
}

}  // namespace product_test
