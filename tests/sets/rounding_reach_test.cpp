// SPDX-License-Identifier: MIT
#include <slant/sets/ball.hpp>
#include <slant/sets/half_line.hpp>
#include <slant/sets/parts/image.hpp>
#include <slant/sets/second_order_cone.hpp>

#include <doctest/doctest.h>

#include <limits>

namespace rounding_reach_test {

using Eigen::Vector2d;
using slant::block_state;
using slant::detail::contains_within;
using slant::detail::state_within;

TEST_CASE("rounding_reach: membership within a distance") {
  slant::ball<2> const disc{1.0};
  CHECK(contains_within(disc, Vector2d(1.0005, 0), 1e-3));
  CHECK(!contains_within(disc, Vector2d(1.002, 0), 1e-3));
  CHECK(contains_within(disc, Vector2d(0.5, 0), 0.0));
  double const infinity = std::numeric_limits<double>::infinity();
  CHECK(!contains_within(disc, Vector2d(infinity, 0), infinity));
  CHECK(!contains_within(disc, Vector2d(std::numeric_limits<double>::quiet_NaN(), 0), 1.0));
}

TEST_CASE("rounding_reach: the most confined state within a distance") {
  slant::ball<2> const disc{1.0};
  CHECK(state_within(disc, Vector2d(0.9, 0), 0.0) == block_state::free);
  CHECK(state_within(disc, Vector2d(0.9, 0), 0.05) == block_state::free);
  CHECK(state_within(disc, Vector2d(0.9, 0), 0.2) == block_state::sliding);
  CHECK(state_within(disc, Vector2d(1.05, 0), 0.2) == block_state::sliding);
  using number = Eigen::Matrix<double, 1, 1>;
  slant::half_line<> const line{0.0};
  CHECK(state_within(line, number(1e-9), 1e-8) == block_state::fixed);
  CHECK(state_within(line, number(1e-7), 1e-8) == block_state::free);
  slant::second_order_cone<2> const cone{1.0};
  CHECK(state_within(cone, Vector2d(1e-9, 0), 1e-8) == block_state::fixed);
  CHECK(state_within(cone, Vector2d(1, 1 - 1e-9), 1e-8) == block_state::sliding);
}

}  // namespace rounding_reach_test
