// SPDX-License-Identifier: MIT
#include <slant/concepts/capabilities.hpp>
#include <slant/concepts/slanting_function.hpp>
#include <slant/factorizations/ldlt.hpp>
#include <slant/operators/operators.hpp>
#include <slant/slanting/affine.hpp>
#include <slant/testing/archetypes.hpp>

#include <support/testing.hpp>
#include "operators/dense_oracle.hpp"

namespace linear_operator_test {

/// What apply says of arguments with these sizes.
template <class A, class V>
std::string complaint(A const& a, V const& x, V y) {
  return SLANT_COMPLAINT(slant::apply(a, x, y));
}

TEST_CASE("apply names the argument whose size is wrong, and resizes nothing") {
  slant::restriction const r(5, {1, 4});
  auto const m = slant::matrix(test::random_dense(2, 5, 1));
  VectorXd const x = VectorXd::Zero(5);
  VectorXd const y = VectorXd::Zero(2);
  auto const check = [&](auto const& a) {
    CHECK(complaint(a, x, y) == "nothing thrown");
    CHECK(complaint(a, x, VectorXd()) == "y: got 0 rows, expected 2 (rows() of the operator)");
    CHECK(complaint(a, x, x) == "y: got 5 rows, expected 2 (rows() of the operator)");
    CHECK(complaint(a, y, y) == "x: got 2 rows, expected 5 (cols() of the operator)");
    CHECK(complaint(a, MatrixXd(5, 3), MatrixXd(2, 2)) ==
          "y: got 2 columns, expected 3 (one for each column of x)");
  };
  check(r);
  check(m);
  VectorXd unsized;
  auto const kinv = slant::inverse(slant::ldlt(test::random_spd(5, 2).sparseView()));
  CHECK(complaint(kinv, x, unsized) == "y: got 0 rows, expected 5 (rows() of the operator)");
  auto w = slant::workspace(kinv, x);
  CHECK(SLANT_COMPLAINT(slant::apply(kinv, x, unsized, w)) ==
        "y: got 0 rows, expected 5 (rows() of the operator)");
}

TEST_CASE("sizes are those of the local parts") {
  using slant::testing::archetype::vector;
  slant::testing::archetype::linear_operator const a(test::random_dense(2, 3, 3));
  vector const x(test::zeros(3));
  vector const y(test::zeros(2));
  CHECK(complaint(a, x, y) == "nothing thrown");
  CHECK(complaint(a, y, y) == "x: got 2 rows, expected 3 (cols() of the operator)");
  CHECK(complaint(a, x, x) == "y: got 3 rows, expected 2 (rows() of the operator)");
}

TEST_CASE("adjoints and accumulations name the argument whose size is wrong") {
  slant::restriction const r(5, {1, 4});
  slant::no_workspace w;
  VectorXd of_five = VectorXd::Ones(5);
  VectorXd of_two = VectorXd::Ones(2);
  VectorXd none;
  auto const add = [&](VectorXd const& x, VectorXd& y) {
    return SLANT_COMPLAINT(slant::apply_add(r, 2.0, x, y, w));
  };
  CHECK(add(of_five, of_two) == "nothing thrown");
  CHECK(add(of_five, none) == "y: got 0 rows, expected 2 (rows() of the operator)");
  CHECK(add(of_two, of_two) == "x: got 2 rows, expected 5 (cols() of the operator)");

  std::string const why = "() of the operator, as the adjoint is applied)";
  auto const adjoint = [&](VectorXd const& x, VectorXd& y) {
    return SLANT_COMPLAINT(slant::apply_adjoint(r, x, y));
  };
  auto const adjoint_add = [&](VectorXd const& x, VectorXd& y) {
    return SLANT_COMPLAINT(slant::apply_adjoint_add(r, 2.0, x, y, w));
  };
  CHECK(adjoint(of_two, of_five) == "nothing thrown");
  CHECK(adjoint(of_two, none) == "y: got 0 rows, expected 5 (cols" + why);
  CHECK(adjoint(of_five, of_five) == "x: got 5 rows, expected 2 (rows" + why);
  CHECK(adjoint_add(of_two, of_five) == "nothing thrown");
  CHECK(adjoint_add(of_two, none) == "y: got 0 rows, expected 5 (cols" + why);
  CHECK(adjoint_add(of_five, of_five) == "x: got 5 rows, expected 2 (rows" + why);
}

TEST_CASE("evaluate and update_slant name the argument whose size is wrong") {
  auto const f = slant::linear(test::random_dense(2, 3, 1));
  VectorXd const two = VectorXd::Ones(2);
  VectorXd const three = VectorXd::Ones(3);
  auto w = slant::workspace(f, three);
  auto const evaluate = [&](VectorXd const& y, VectorXd v) {
    return SLANT_COMPLAINT(slant::evaluate(f, y, v, w));
  };
  CHECK(evaluate(three, two) == "nothing thrown");
  CHECK(evaluate(three, VectorXd()) == "f: got 0 rows, expected 2 (rows() of the function)");
  CHECK(evaluate(two, two) == "y: got 2 rows, expected 3 (cols() of the function)");
  CHECK(SLANT_COMPLAINT(slant::evaluate(f, two)) ==
        "y: got 2 rows, expected 3 (cols() of the function)");
  auto g = f.slant(three);
  CHECK(SLANT_COMPLAINT(slant::update_slant(f, two, g, w)) ==
        "y: got 2 rows, expected 3 (cols() of the function)");
  CHECK(SLANT_COMPLAINT(slant::update_slant_after_value(f, two, g, w)) ==
        "y: got 2 rows, expected 3 (cols() of the function)");
}

}  // namespace linear_operator_test
