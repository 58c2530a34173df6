// SPDX-License-Identifier: MIT
#include <slant/contact/friction/friction_options.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "support/message.hpp"

namespace friction_options_test {

using slant::contact::friction_method;

/// What validate says of the options after a change.
template <class Change>
std::string complaint(Change change) {
  slant::contact::friction_options<double> o;
  change(o);
  return test::complaint([&] { o.validate(); });
}

TEST_CASE("friction options: the defaults are valid, each bad one is named") {
  auto const names = [](std::string const& text, char const* name) {
    return text.find(name) != std::string::npos;
  };
  CHECK(complaint([](auto&) {}) == "nothing thrown");
  CHECK(names(complaint([](auto& o) { o.tolerance = 0; }), "tolerance"));
  CHECK(names(complaint([](auto& o) { o.tolerance = std::nan(""); }), "tolerance"));
  CHECK(names(complaint([](auto& o) { o.damping = -1; }), "damping"));
  CHECK(names(complaint([](auto& o) { o.first_sweeps = -1; }), "first_sweeps"));
  CHECK(names(complaint([](auto& o) { o.further_sweeps = -1; }), "further_sweeps"));
  CHECK(names(complaint([](auto& o) { o.sweeps = -1; }), "sweeps"));
  CHECK(names(complaint([](auto& o) { o.newton_steps = -1; }), "newton_steps"));
  CHECK(names(complaint([](auto& o) { o.interior_steps = -1; }), "interior_steps"));
  CHECK(names(complaint([](auto& o) { o.interior_point.fraction = 1; }), "fraction"));
  CHECK(names(complaint([](auto& o) { o.attempt = 0; }), "attempt"));
  CHECK(names(complaint([](auto& o) { o.halvings = -1; }), "halvings"));
  CHECK(names(complaint([](auto& o) { o.patience = 0; }), "patience"));
  CHECK(names(complaint([](auto& o) { o.gauss_seidel.shrink = 2; }), "shrink"));
}

TEST_CASE("friction options: methods have names") {
  CHECK(to_string(friction_method::automatic) == "automatic");
  CHECK(to_string(friction_method::gauss_seidel) == "gauss_seidel");
  CHECK(to_string(friction_method::newton) == "newton");
  CHECK(to_string(friction_method::interior_point) == "interior_point");
}

}  // namespace friction_options_test
