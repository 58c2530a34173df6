// SPDX-License-Identifier: MIT
#include <slant/concepts/bad_input.hpp>

#include <support/testing.hpp>

namespace bad_input_test {

TEST_CASE("bad_input: argument, value, expectation") {
  slant::bad_input const e("radius", "-1", "a number >= 0");
  CHECK(std::string(e.what()) == "radius: got -1, expected a number >= 0");
  CHECK_THROWS_AS(throw e, std::invalid_argument);
  CHECK(std::string(e.at(3).what()) == "radius[3]: got -1, expected a number >= 0");
  CHECK(std::string(e.at(3).at(4).what()) == "radius[3][4]: got -1, expected a number >= 0");
}

TEST_CASE("bad_input: numbers are shown with all the digits they need") {
  CHECK(slant::detail::show(0.1) == "0.1");
  CHECK(slant::detail::show(0.1 + 0.2) == "0.30000000000000004");
  CHECK(slant::detail::show(1e-7) == "1e-07");
  CHECK(slant::detail::show(0.1f) == "0.1");
  CHECK(slant::detail::show(7) == "7");
  CHECK(slant::detail::show(std::numeric_limits<double>::infinity()) == "inf");
}

}  // namespace bad_input_test
