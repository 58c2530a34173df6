// SPDX-License-Identifier: MIT
#include <slant/operators/operators.hpp>
#include <slant/testing/archetypes.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>
#include "operators/dense_oracle.hpp"

namespace any_operator_test {

using any = slant::any_operator<VectorXd>;
using any_spd =
    slant::any_operator<VectorXd, slant::laws<slant::self_adjoint, slant::positive_definite>>;

TEST_CASE("operators of different types in one container") {
  MatrixXd const m = test::random_dense(3, 3, 1);
  std::vector<any> operators;
  operators.emplace_back(m);
  operators.emplace_back(slant::identity(3));
  operators.emplace_back(slant::product(m, m));
  operators.push_back(operators[2]);  // shares
  CHECK(test::matches(operators[0], m));
  CHECK(test::matches(operators[1], MatrixXd(MatrixXd::Identity(3, 3))));
  CHECK(test::matches(operators[2], MatrixXd(m * m)));
  CHECK(test::matches(operators[3], MatrixXd(m * m)));
  for (auto const& a : operators) slant::testing::check_operator_laws(a);
  CHECK(test::matches(slant::sum(operators[0], operators[1], operators[2]),
                      MatrixXd(m + MatrixXd::Identity(3, 3) + m * m)));
}

TEST_CASE("copies of a workspace have contents of their own") {
  MatrixXd const m = test::random_dense(3, 3, 4);
  any const a = slant::product(m, m);
  VectorXd const x = test::random_column(3, 5);
  VectorXd y(3);
  auto w = std::make_unique<slant::any_workspace>(a.workspace(x));
  auto copy = *w;
  auto assigned = any(slant::identity(3)).workspace(x);
  assigned = *w;
  w.reset();
  for (auto* own : {&copy, &assigned}) {
    slant::apply(a, x, y, *own);
    CHECK((y - m * m * x).norm() < 1e-14);
  }
}

TEST_CASE("laws are part of the type and must be declared by what is put in") {
  MatrixXd const m = test::random_spd(3, 2);
  using definite = decltype(slant::matrix<slant::self_adjoint, slant::positive_definite>(m));
  using symmetric = decltype(slant::matrix<slant::self_adjoint>(m));
  static_assert(slant::spd_operator<any_spd, VectorXd>);
  static_assert(!slant::self_adjoint_operator<any, VectorXd>);
  static_assert(std::is_constructible_v<any_spd, definite>);
  static_assert(!std::is_constructible_v<any_spd, symmetric>);
  static_assert(std::is_constructible_v<any, any_spd>);
  static_assert(!std::is_constructible_v<any_spd, any>);
  static_assert(!std::is_constructible_v<any, slant::testing::archetype::linear_operator>);
  any_spd const a = slant::matrix<slant::self_adjoint, slant::positive_definite>(m);
  slant::testing::check_operator_laws(a);
}

TEST_CASE("lvalues are referenced, rvalues owned") {
  VectorXd d = VectorXd::Ones(2);
  auto const diagonal = slant::diagonal(d);
  any const a = diagonal;
  d[1] = 7;
  VectorXd y(2);
  slant::apply(a, VectorXd(VectorXd::Ones(2)), y);
  CHECK(y[1] == 7);
}

TEST_CASE("on archetype vectors") {
  namespace archetype = slant::testing::archetype;
  slant::any_operator<archetype::vector> const a =
      archetype::linear_operator(test::random_dense(3, 3, 3));
  slant::testing::check_operator_laws(a, archetype::vector(VectorXd()));
}

}  // namespace any_operator_test
