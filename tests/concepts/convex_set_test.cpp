// SPDX-License-Identifier: MIT
#include <slant/sets/sets.hpp>
#include <slant/testing/archetypes.hpp>

#include <support/testing.hpp>
#include "operators/dense_oracle.hpp"

namespace convex_set_test {

using slant::bad_input;

TEST_CASE("project names the argument whose size is wrong, and resizes nothing") {
  auto const check = [](auto const& set) {
    auto const in_place = [&](VectorXd const& x, VectorXd y) {
      return test::message<bad_input>([&] { slant::project(set, x, y); });
    };
    VectorXd const two = VectorXd::Ones(2);
    VectorXd const three = VectorXd::Ones(3);
    CHECK(in_place(two, two) == "nothing thrown");
    CHECK(in_place(two, VectorXd()) == "y: got 0 rows, expected 2 (the dimension of the set)");
    CHECK(in_place(two, three) == "y: got 3 rows, expected 2 (the dimension of the set)");
    CHECK(in_place(three, two) == "x: got 3 rows, expected 2 (the dimension of the set)");
    CHECK(test::message<bad_input>([&] { (void)slant::project(set, three); }) ==
          "x: got 3 rows, expected 2 (the dimension of the set)");
  };
  check(slant::ball<2>(1.0));
  check(slant::half_lines(2));
  check(slant::testing::archetype::basic_convex_set<VectorXd>(2));
}

}  // namespace convex_set_test
