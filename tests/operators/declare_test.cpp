// SPDX-License-Identifier: MIT
#include <slant/operators/operators.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>
#include "operators/dense_oracle.hpp"

namespace declare_test {

TEST_CASE("a product of commuting matrices is declared to be what it is") {
  using namespace slant;
  MatrixXd const m = test::random_spd(4, 1);
  auto const p = product(m, m);
  auto const a = declare<self_adjoint, positive_definite>(p);
  static_assert(!self_adjoint_operator<decltype(p), VectorXd>);
  static_assert(spd_operator<decltype(a), VectorXd>);
  static_assert(has_accumulate<decltype(a), VectorXd>);
  static_assert(has_columns<decltype(a), MatrixXd>);
  CHECK(test::matches(a, MatrixXd(m * m)));
  testing::check_operator_laws(a);
}

TEST_CASE("laws of the operator are kept, with what follows from both") {
  using namespace slant;
  auto const d = slant::diagonal<projector>(VectorXd(VectorXd::Unit(3, 1)));
  auto const p = declare<projector>(matrix<self_adjoint>(MatrixXd(MatrixXd::Identity(3, 3))));
  static_assert(laws_of<decltype(p)> == laws_of<decltype(d)>);
  static_assert(declares_firmly_nonexpansive<decltype(p)>);
  testing::check_operator_laws(p);
}

TEST_CASE("the inverse has what the declared laws imply") {
  using namespace slant;
  auto const d = diagonal<positive_definite>(VectorXd(VectorXd::LinSpaced(3, 1, 2)));
  auto const a = declare<self_adjoint, positive_definite>(product(op<"D">(d), d));
  auto const b = inverse(a);
  static_assert(spd_operator<decltype(b), VectorXd>);
  static_assert(spd_operator<decltype(inverse(b)), VectorXd>);
  static_assert(
      laws_of<decltype(inverse(declare<positive_semidefinite>(product(op<"D">(d), d))))> ==
      laws<law::positive_semidefinite>);
  static_assert(!has_inverse<decltype(declare<self_adjoint>(MatrixXd(3, 3))), VectorXd>);
  testing::check_operator_laws(a);
  testing::check_operator_laws(b);
}

TEST_CASE("a false declaration is found by the law check") {
  MatrixXd const m = test::random_dense(4, 4, 2);
  CHECK(!slant::testing::operator_breaches(slant::declare<slant::self_adjoint>(m)).empty());
}

TEST_CASE("only square operators have laws") {
  CHECK(SLANT_COMPLAINT(slant::declare<slant::self_adjoint>(MatrixXd(MatrixXd::Ones(2, 3)))) ==
        "A: got 2 x 3, expected a square operator");
}

}  // namespace declare_test
