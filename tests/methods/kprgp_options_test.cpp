// SPDX-License-Identifier: MIT
#include <slant/methods/proportioning.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>

namespace kprgp_options_test {

using options = slant::kprgp_options<double>;

std::string complaint(options const& o) {
  try {
    o.validate();
  } catch (slant::bad_input const& e) {
    return e.what();
  }
  return "";
}

TEST_CASE("options out of range are named with their value and what was expected") {
  constexpr double inf = std::numeric_limits<double>::infinity();
  CHECK(complaint({}) == "");
  CHECK(complaint(
            {.proportioning = 1e-9, .step_length = 1e-150, .step_factor = 1.99, .refresh = 0}) ==
        "");
  CHECK(complaint({.proportioning = 0}) == "proportioning: got 0, expected a number > 0");
  CHECK(complaint({.proportioning = std::nan("")}) ==
        "proportioning: got nan, expected a number > 0");
  CHECK(complaint({.proportioning = inf}) == "proportioning: got inf, expected a number > 0");
  CHECK(complaint({.step_length = -1.0}) == "step_length: got -1, expected a number > 0");
  CHECK(complaint({.step_length = inf}) == "step_length: got inf, expected a number > 0");
  CHECK(complaint({.step_factor = 2}) == "step_factor: got 2, expected a number in (0, 2)");
  CHECK(complaint({.step_factor = 0}) == "step_factor: got 0, expected a number in (0, 2)");
  CHECK(complaint({.refresh = -1}) == "refresh: got -1, expected a number >= 0");
  CHECK(complaint({.patience = -1}) == "patience: got -1, expected a number >= 0");
  CHECK(complaint({.spectrum = {.steps = 1}}) == "steps: got 1, expected at least 2 Lanczos steps");
}

}  // namespace kprgp_options_test
