// SPDX-License-Identifier: MIT
#include <slant/iteration/stopping.hpp>

#include <support/testing.hpp>
#include "toy_method.hpp"

namespace stopping_test {

using slant::status;

toy::state at(slant::index iteration, double residual, double scale = 1) {
  return {residual, residual, scale, iteration, status::running};
}

struct with_gradient {
  double x = 0;
  double reduced_gradient_norm = 0;
  double gradient_scale = 0;
  slant::index iteration = 0;
  slant::status status = slant::status::running;
};

TEST_CASE("at_most counts steps") {
  slant::at_most rule(5);
  CHECK(rule(at(4, 1)) == status::running);
  CHECK(rule(at(5, 1)) == status::iteration_limit);
  CHECK(rule.reason(at(5, 1)) == "reached the limit of 5 steps");
  CHECK_THROWS_WITH_AS(slant::at_most(-1), "at_most: got -1, expected a number of steps >= 0",
                       slant::bad_input);
}

TEST_CASE("accuracy is relative to the scale of the state, in any unit") {
  slant::residual_below rule(1e-3);
  for (double unit : {1e-300, 1e-12, 1.0, 1e12, 1e300}) {
    CHECK(rule(at(0, 1.01e-3 * unit, unit)) == status::running);
    CHECK(rule(at(0, 0.99e-3 * unit, unit)) == status::converged);
  }
  slant::reduced_gradient_below gradient(1e-3);
  CHECK(gradient(with_gradient{0, 2e-3, 1.0}) == status::running);
  CHECK(gradient(with_gradient{0, 2e-3, 4.0}) == status::converged);
}

TEST_CASE("a residual that is not a number never counts as converged") {
  slant::residual_below rule(1e-3);
  CHECK(rule(at(0, std::nan(""), 1)) == status::running);
  CHECK(rule(at(0, 1, std::nan(""))) == status::running);
}

TEST_CASE("an exact zero satisfies every tolerance, zero included") {
  slant::residual_below rule(0.0);
  CHECK(rule(at(0, 0, 0)) == status::converged);
  CHECK(rule(at(0, std::numeric_limits<double>::denorm_min(), 1)) == status::running);
}

TEST_CASE("tolerances are checked") {
  CHECK_THROWS_AS(slant::residual_below(-1e-3), slant::bad_input);
  CHECK_THROWS_AS(slant::residual_below(1.0), slant::bad_input);
  CHECK_THROWS_WITH_AS(slant::reduced_gradient_below(std::nan("")),
                       "tolerance: got nan, expected a relative accuracy in [0, 1)",
                       slant::bad_input);
}

TEST_CASE("either rule: the first that fires gives status and reason") {
  auto rule = slant::residual_below(1e-3) || slant::at_most(5);
  CHECK(rule(at(0, 1)) == status::running);
  CHECK(rule(at(5, 1)) == status::iteration_limit);
  CHECK(rule.reason(at(5, 1)) == "reached the limit of 5 steps");
  CHECK(rule(at(5, 1e-4)) == status::converged);
  CHECK(rule.reason(at(5, 1e-4)).find("relative residual") == 0);
}

TEST_CASE("both rules: only together, and the less happy status wins") {
  auto rule = slant::residual_below(1e-3) && slant::at_most(5);
  CHECK(rule(at(9, 1)) == status::running);
  CHECK(rule(at(0, 1e-4)) == status::running);
  CHECK(rule(at(5, 1e-4)) == status::iteration_limit);
  CHECK(rule.reason(at(5, 1e-4)).find(" and ") != std::string::npos);
  auto converged = slant::residual_below(1e-3) && slant::residual_below(1e-2);
  CHECK(converged(at(0, 5e-3)) == status::running);
  CHECK(converged(at(0, 5e-4)) == status::converged);
}

TEST_CASE("rules nest, and client rules take part") {
  struct every_even : slant::rule {
    status operator()(toy::state const& s) const {
      return s.iteration > 0 && s.iteration % 2 == 0 ? status::interrupted : status::running;
    }
    std::string reason(toy::state const&) const { return "an even step"; }
  };
  auto rule = every_even{} || (slant::residual_below(1e-3) && slant::at_most(0)) ||
              slant::stop_when([](toy::state const& s) { return s.x > 100; }, "x ran away",
                               status::stalled);
  CHECK(rule(at(1, 1)) == status::running);
  CHECK(rule(at(2, 1)) == status::interrupted);
  CHECK(rule.reason(at(2, 1)) == "an even step");
  CHECK(rule(at(1, 1000)) == status::stalled);
  CHECK(rule.reason(at(1, 1000)) == "x ran away");
}

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
  CHECK(rule.reason(state{0.5, 1024}) == "relative step 0.5 / 1.02e+03 is at most 0.001");
  CHECK(printed.reason(state{0.5, 1024}) == "relative step 0.5 / (1.02e+03 + 1) is at most 0.001");
}

TEST_CASE("before the first step, out of range, NaN: no success") {
  slant::step_below const rule(1e-3);
  CHECK(rule(state{infinity, 1}) == slant::status::running);
  CHECK(rule(state{1, infinity}) == slant::status::running);
  CHECK(rule(state{quiet_nan, 1}) == slant::status::running);
  CHECK(rule(state{1, quiet_nan}) == slant::status::running);
}

TEST_CASE("bad input is named") {
  CHECK_THROWS_AS(slant::step_below(1.0), slant::bad_input);
  CHECK_THROWS_WITH_AS(slant::step_below(0.5, -1.0),
                       "offset: got -1, expected a number >= 0, in units of y", slant::bad_input);
}

}  // namespace stopping_test
