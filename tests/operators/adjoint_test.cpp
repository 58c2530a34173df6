// SPDX-License-Identifier: MIT
#include <slant/operators/operators.hpp>
#include <slant/testing/archetypes.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>
#include "operators/dense_oracle.hpp"

namespace adjoint_test {

namespace archetype = slant::testing::archetype;

TEST_CASE("the adjoint is the transposed matrix") {
  auto const s = test::random_sparse(4, 6, 1);
  auto const a = slant::adjoint(s);
  CHECK(test::matches(a, MatrixXd(MatrixXd(s).transpose())));
  static_assert(slant::has_accumulate<decltype(a), VectorXd>);
  static_assert(slant::has_adjoint_accumulate<decltype(a), VectorXd>);
  static_assert(slant::has_columns<decltype(a), MatrixXd>);
  slant::testing::check_operator_laws(a);
  CHECK(test::matches(slant::adjoint(a), MatrixXd(s)));
  MatrixXd const square = test::random_dense(5, 5, 2);
  slant::testing::check_operator_laws(slant::adjoint(square));  // the diagonal, too
}

TEST_CASE("archetypes: only what has an adjoint") {
  archetype::vector const x(test::random_column(4, 4));
  MatrixXd const m = test::random_spd(4, 5);
  archetype::operator_with_adjoint const a(m);
  slant::testing::check_operator_laws(slant::adjoint(a), x);
  // self-adjoint operators have it for free
  archetype::spd_operator const b(m);
  auto const t = slant::adjoint(b);
  static_assert(slant::spd_operator<decltype(t), archetype::vector>);
  slant::testing::check_operator_laws(t, x);
  static_assert(!slant::linear_operator<slant::expr::adjoint_view<archetype::linear_operator>,
                                        archetype::vector>);
}

}  // namespace adjoint_test
