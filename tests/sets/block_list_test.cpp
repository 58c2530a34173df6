// SPDX-License-Identifier: MIT
#include <slant/sets/ball.hpp>
#include <slant/sets/blocks.hpp>
#include <slant/sets/interval.hpp>
#include <slant/testing/archetypes.hpp>

#include <doctest/doctest.h>

#include <vector>

namespace block_list_test {

using slant::detail::parameter_list;
using slant::detail::takes_parameters;

TEST_CASE("block_list: what counts as a list of parameters") {
  static_assert(parameter_list<std::vector<double>>);
  static_assert(parameter_list<Eigen::VectorXf>);
  static_assert(parameter_list<decltype(-Eigen::VectorXd())>);
  static_assert(parameter_list<slant::testing::archetype::vector>);
  static_assert(!parameter_list<double>);
  static_assert(takes_parameters<slant::ball<2>, std::vector<double>>);
  static_assert(takes_parameters<slant::interval<>, double, Eigen::VectorXd>);
  static_assert(!takes_parameters<slant::interval<>, Eigen::VectorXd>);
  static_assert(!takes_parameters<slant::ball<2>, std::vector<const char*>>);
}

TEST_CASE("block_list: entries of all kinds of lists") {
  using slant::detail::parameter_at;
  CHECK(parameter_at(std::vector<double>{1, 2}, 1) == 2.0);
  CHECK(parameter_at(7.0, 5) == 7.0);
  Eigen::VectorXd const g = Eigen::Vector2d(3, 4);
  CHECK(parameter_at(-g, 1) == -4.0);
  CHECK(parameter_at(slant::testing::archetype::vector(g), 0) == 3.0);
  CHECK(slant::detail::parameter_count(1.0, g, 2.0, g) == 2);
}

TEST_CASE("block_list: copies of a block share it") {
  slant::detail::identical_blocks<slant::ball<2>> const blocks(slant::ball<2>{3.0}, 1000000);
  CHECK(blocks.size() == 1000000);
  CHECK(blocks[999999].radius() == 3.0);
  CHECK(&blocks[0] == &blocks[5]);
}

}  // namespace block_list_test
