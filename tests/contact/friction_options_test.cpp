// SPDX-License-Identifier: MIT
#include <slant/contact/solve_friction.hpp>
#include <support/testing.hpp>

namespace friction_options_test {

using slant::contact::friction_method;
using options = slant::contact::friction_options<double>;

TEST_CASE("friction options: the defaults are valid, each bad one is named") {
  CHECK(test::complaint([] { options{}.validate(); }) == "nothing thrown");
  struct bad {
    char const* name;
    options o;
  };
  for (auto const& [name, o] :
       {bad{"tolerance", {.tolerance = 0}},
        {"tolerance", {.tolerance = std::numeric_limits<double>::quiet_NaN()}},
        {"first_sweeps", {.first_sweeps = -1}},
        {"further_sweeps", {.further_sweeps = -1}},
        {"sweeps", {.sweeps = -1}},
        {"newton_steps", {.newton_steps = -1}},
        {"interior_steps", {.interior_steps = -1}},
        {"attempt", {.attempt = 0}},
        {"halvings", {.halvings = -1}},
        {"damping", {.damping = -1}},
        {"patience", {.patience = 0}},
        {"shrink", {.gauss_seidel = {.shrink = 2}}},
        {"fraction", {.interior_point = {.fraction = 1}}}}) {
    CAPTURE(name);
    CHECK(test::complaint([&o = o] { o.validate(); }).find(name) != std::string::npos);
  }
}

TEST_CASE("friction options: methods have names") {
  CHECK(to_string(friction_method::automatic) == "automatic");
  CHECK(to_string(friction_method::gauss_seidel) == "gauss_seidel");
  CHECK(to_string(friction_method::newton) == "newton");
  CHECK(to_string(friction_method::interior_point) == "interior_point");
}

}  // namespace friction_options_test
