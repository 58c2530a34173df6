// SPDX-License-Identifier: MIT
#include <slant/methods/successive_approximations.hpp>

#include <doctest/doctest.h>

#include <limits>
#include <string>

namespace successive_options_test {

TEST_CASE("options out of range are refused") {
  auto const message = [](slant::successive_options<double> const& o) -> std::string {
    try {
      o.validate();
    } catch (slant::bad_input const& e) {
      return e.what();
    }
    return "accepted";
  };
  CHECK(message({.window = -1}) == "window: got -1, expected a number >= 0");
  CHECK(message({.growth = 0.5}) == "growth: got 0.5, expected a finite number >= 1");
  CHECK(message({.growth = std::numeric_limits<double>::infinity()}) ==
        "growth: got inf, expected a finite number >= 1");
  CHECK(message({.relaxation = 0}) == "relaxation: got 0, expected a number in (0, 1]");
  CHECK(message({.inner_steps = 0}) == "inner_steps: got 0, expected at least 1");
  CHECK(message({.patience = 0}) == "patience: got 0, expected at least 1");
  CHECK(message({.relaxation = 2}) == "relaxation: got 2, expected a number in (0, 1]");
  auto forcing = slant::successive_options<double>{}.forcing;
  forcing.η_max = 2;
  CHECK(message({.forcing = forcing}) != "accepted");
  CHECK(message({}) == "accepted");
  CHECK(message({.window = 0, .growth = 1}) == "accepted");
}

}  // namespace successive_options_test
