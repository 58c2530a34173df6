// SPDX-License-Identifier: MIT
//
// The laws of convex sets hold in fifty digits as well.
#include <slant/sets/cartesian.hpp>
#include <slant/sets/contact_sets.hpp>
#include <slant/testing/set_laws.hpp>

#include "oracle/precise.hpp"

#include <doctest/doctest.h>

#include <vector>

namespace set_multiprecision_test {

TEST_CASE("laws: a product in multiprecision") {
  using S = oracle::float_50;
  std::vector<S> const g{S(1), S(3) / S(10)};
  slant::testing::set_options const few{.points = 12, .directions = 2};
  slant::testing::check_set_laws(
      slant::cartesian(slant::half_lines<S>(1), slant::discs<slant::planar>(g)), few);
}

}  // namespace set_multiprecision_test
