// SPDX-License-Identifier: MIT
#include <slant/operators/operators.hpp>
#include <slant/testing/archetypes.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>
#include "operators/dense_oracle.hpp"

namespace difference_test {

using namespace test::evaluated;
namespace archetype = slant::testing::archetype;

TEST_CASE("a difference is the difference of the matrices") {
  auto const s = test::random_sparse(4, 4, 1);
  MatrixXd const m = test::random_dense(4, 4, 2);
  auto const a = slant::difference(s, m);
  CHECK(test::matches(a, MatrixXd(MatrixXd(s) - m)));
  static_assert(slant::has_accumulate<decltype(a), VectorXd>);
  static_assert(slant::has_adjoint_accumulate<decltype(a), VectorXd>);
  static_assert(slant::has_diagonal<decltype(a), VectorXd>);
  static_assert(slant::has_columns<decltype(a), MatrixXd>);
  slant::testing::check_operator_laws(a);
  MatrixXd const d = test::random_spd(3, 3);
  slant::testing::check_operator_laws(slant::difference(
      slant::matrix<slant::self_adjoint, slant::positive_definite>(d), slant::identity(3)));
}

TEST_CASE("parts without apply_add work through a temporary") {
  MatrixXd const m = test::random_dense(4, 4, 4);
  archetype::operator_with_adjoint const a(m);
  auto const d = slant::difference(slant::identity(4), a);
  static_assert(!slant::has_accumulate<decltype(d), archetype::vector>);
  static_assert(!slant::has_adjoint_accumulate<decltype(d), archetype::vector>);
  archetype::vector const x(test::random_column(4, 5));
  archetype::vector y(VectorXd::Zero(4));
  slant::apply(d, x, y);
  CHECK((y.local() - (x.local() - m * x.local())).norm() < 1e-14);
  slant::testing::check_operator_laws(d, x);
}

TEST_CASE("sizes must agree") {
  CHECK(test::message<slant::bad_input>([] {
          (void)slant::difference(MatrixXd(MatrixXd::Ones(3, 2)), slant::identity(3));
        }) == "B: got 3 x 3, expected 3 x 2 (the size of A)");
}

}  // namespace difference_test
