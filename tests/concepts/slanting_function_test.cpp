// SPDX-License-Identifier: MIT
#include <slant/concepts/slanting_function.hpp>
#include <slant/slanting/affine.hpp>

#include <support/testing.hpp>
#include "operators/dense_oracle.hpp"

namespace slanting_function_test {

using slant::bad_input;

TEST_CASE("evaluate and update_slant name the argument whose size is wrong") {
  auto const f = slant::linear(test::random_dense(2, 3, 1));
  VectorXd const two = VectorXd::Ones(2);
  VectorXd const three = VectorXd::Ones(3);
  auto w = slant::workspace(f, three);
  auto const evaluate = [&](VectorXd const& y, VectorXd v) {
    return test::message<bad_input>([&] { slant::evaluate(f, y, v, w); });
  };
  CHECK(evaluate(three, two) == "nothing thrown");
  CHECK(evaluate(three, VectorXd()) == "f: got 0 rows, expected 2 (rows() of the function)");
  CHECK(evaluate(two, two) == "y: got 2 rows, expected 3 (cols() of the function)");
  CHECK(SLANT_COMPLAINT(slant::evaluate(f, two)) ==
        "y: got 2 rows, expected 3 (cols() of the function)");
  auto g = f.slant(three);
  CHECK(test::message<bad_input>([&] { slant::update_slant(f, two, g, w); }) ==
        "y: got 2 rows, expected 3 (cols() of the function)");
  CHECK(test::message<bad_input>([&] { slant::update_slant_after_value(f, two, g, w); }) ==
        "y: got 2 rows, expected 3 (cols() of the function)");
}

}  // namespace slanting_function_test
