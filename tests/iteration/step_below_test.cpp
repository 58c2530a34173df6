// SPDX-License-Identifier: MIT
#include <slant/iteration/stopping.hpp>

#include <doctest/doctest.h>

#include <limits>

namespace step_below_test {

struct state {
  double step_norm;
  double x_norm;
};

TEST_CASE("a relative step, with and without an offset") {
  slant::step_below const rule(1e-3);
  CHECK(rule(state{0.9e-3, 1.0}) == slant::status::converged);
  CHECK(rule(state{1.1e-3, 1.0}) == slant::status::running);
  CHECK(rule(state{0.9e-153, 1e-150}) == slant::status::converged);
  CHECK(rule(state{1e-9, 1e-9}) == slant::status::running);
  slant::step_below const printed(1e-3, 1.0);  // [T]
  CHECK(printed(state{1e-9, 1e-9}) == slant::status::converged);
  CHECK(printed(state{1.9e-3, 1.0}) == slant::status::converged);
  CHECK(printed(state{2.1e-3, 1.0}) == slant::status::running);
  CHECK(rule.reason(state{0.5, 1024}) == "relative step 0.5 / 1024 is at most 0.001");
  CHECK(printed.reason(state{0.5, 1024}) == "relative step 0.5 / (1024 + 1) is at most 0.001");
}

TEST_CASE("before the first step, out of range, NaN: no success") {
  slant::step_below const rule(1e-3);
  double const infinity = std::numeric_limits<double>::infinity();
  double const nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(rule(state{infinity, 1}) == slant::status::running);
  CHECK(rule(state{1, infinity}) == slant::status::running);
  CHECK(rule(state{nan, 1}) == slant::status::running);
  CHECK(rule(state{1, nan}) == slant::status::running);
}

TEST_CASE("bad input is named") {
  CHECK_THROWS_AS(slant::step_below(1.0), slant::bad_input);
  CHECK_THROWS_WITH_AS(slant::step_below(0.5, -1.0),
                       "offset: got -1, expected a number >= 0, in units of y", slant::bad_input);
}

}  // namespace step_below_test
