// SPDX-License-Identifier: MIT
#include <slant/factorizations/ldlt.hpp>
#include <slant/operators/operators.hpp>
#include <slant/testing/archetypes.hpp>

#include <support/testing.hpp>
#include "operators/dense_oracle.hpp"

namespace linear_operator_test {

using slant::bad_input;

/// What apply says of arguments with these sizes.
template <class A, class V>
std::string complaint(A const& a, V const& x, V y) {
  return test::message<bad_input>([&] { slant::apply(a, x, y); });
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
  CHECK(test::message<bad_input>([&] { slant::apply(kinv, x, unsized, w); }) ==
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

}  // namespace linear_operator_test
