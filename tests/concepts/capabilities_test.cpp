// SPDX-License-Identifier: MIT
#include <slant/concepts/capabilities.hpp>
#include <slant/operators/restriction.hpp>

#include <support/testing.hpp>
#include "operators/dense_oracle.hpp"

namespace capabilities_test {

using slant::bad_input;

TEST_CASE("adjoints and accumulations name the argument whose size is wrong") {
  slant::restriction const r(5, {1, 4});
  slant::no_workspace w;
  VectorXd of_five = VectorXd::Ones(5);
  VectorXd of_two = VectorXd::Ones(2);
  VectorXd none;
  auto const add = [&](VectorXd const& x, VectorXd& y) {
    return test::message<bad_input>([&] { slant::apply_add(r, 2.0, x, y, w); });
  };
  CHECK(add(of_five, of_two) == "nothing thrown");
  CHECK(add(of_five, none) == "y: got 0 rows, expected 2 (rows() of the operator)");
  CHECK(add(of_two, of_two) == "x: got 2 rows, expected 5 (cols() of the operator)");

  std::string const why = "() of the operator, as the adjoint is applied)";
  auto const adjoint = [&](VectorXd const& x, VectorXd& y) {
    return test::message<bad_input>([&] { slant::apply_adjoint(r, x, y); });
  };
  auto const adjoint_add = [&](VectorXd const& x, VectorXd& y) {
    return test::message<bad_input>([&] { slant::apply_adjoint_add(r, 2.0, x, y, w); });
  };
  CHECK(adjoint(of_two, of_five) == "nothing thrown");
  CHECK(adjoint(of_two, none) == "y: got 0 rows, expected 5 (cols" + why);
  CHECK(adjoint(of_five, of_five) == "x: got 5 rows, expected 2 (rows" + why);
  CHECK(adjoint_add(of_two, of_five) == "nothing thrown");
  CHECK(adjoint_add(of_two, none) == "y: got 0 rows, expected 5 (cols" + why);
  CHECK(adjoint_add(of_five, of_five) == "x: got 5 rows, expected 2 (rows" + why);
}

}  // namespace capabilities_test
