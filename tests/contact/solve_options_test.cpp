// SPDX-License-Identifier: MIT
#include <slant/contact/solve_options.hpp>
#include <support/testing.hpp>

namespace solve_options_test {

TEST_CASE("contact::solve_options: values out of range are named") {
  using options = slant::contact::solve_options<double>;
  CHECK(test::complaint([] { options{}.validate(); }) == "nothing thrown");
  CHECK(test::complaint([] { options{.tolerance = 0}.validate(); }) == "nothing thrown");
  CHECK(
      test::complaint([] { options{.tolerance = 1}.validate(); }).starts_with("tolerance: got 1"));
  CHECK(test::complaint([] { options{.max_steps = -1}.validate(); }) ==
        "max_steps: got -1, expected at least 0");
  CHECK(slant::contact::solution<double>{}.motions.dimension() == 0);
}

}  // namespace solve_options_test
