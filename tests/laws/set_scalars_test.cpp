// SPDX-License-Identifier: MIT
//
// The laws of convex sets hold at any precision.
#include <slant/sets/cartesian.hpp>
#include <slant/sets/contact_sets.hpp>
#include <slant/testing/set_laws.hpp>

#include <doctest/doctest.h>

#include <vector>

namespace set_scalars_test {

TEST_CASE_TEMPLATE("laws: a product in other scalars", S, float, long double) {
  std::vector<S> const g{S(1), S(3) / S(10)};
  slant::testing::set_options const few{.points = 12, .directions = 2};
  slant::testing::check_set_laws(
      slant::cartesian(slant::half_lines<S>(1), slant::discs<slant::planar>(g)), few);
}

}  // namespace set_scalars_test
