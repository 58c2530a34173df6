// SPDX-License-Identifier: MIT
#include <slant/concepts/linear_operator.hpp>
#include <slant/sets/ball.hpp>
#include <slant/sets/cartesian.hpp>
#include <slant/sets/free_space.hpp>
#include <slant/sets/power.hpp>
#include <slant/sets/slants.hpp>

#include "counting_disc.hpp"
#include "support/allocation_guard.hpp"

#include <doctest/doctest.h>

namespace projection_slant_test {

using namespace products;

TEST_CASE("projection_slant: a block gives an operator with one block") {
  slant::ball<2> const disc{1.0};
  vec<> const x = Eigen::Vector2d(3, 4);
  vec<> const h = Eigen::Vector2d(1, 2);
  auto g = slant::projection_slant(disc, x);
  static_assert(slant::psd_operator<decltype(g), vec<>>);
  vec<> y(2);
  g.apply(h, y);
  CHECK((y - disc.slant(x) * h).norm() <= 1e-16);
  slant::testing::allocation_guard const guard;
  slant::projection_slant(disc, vec<>::Zero(2), g);
  auto const allocations = guard.count();
  CHECK(allocations == 0);
  g.apply(h, y);
  CHECK(y == h);
}

TEST_CASE("projection_slant: a product gives its own operator") {
  auto const set = slant::power(slant::ball<2>{}, 2);
  vec<> const x = numbers(4, 1);
  auto g = slant::projection_slant(set, vec<>(vec<>::Zero(4)));
  slant::projection_slant(set, x, g);
  vec<> y(4);
  vec<> expected(4);
  g.apply(x, y);
  set.slant(x).apply(x, expected);
  CHECK(y == expected);
}

TEST_CASE("projection_slant: the whole space gives the identity without storage") {
  auto const g = slant::projection_slant(slant::free_space<2>{}, vec<>(vec<>::Zero(2)));
  static_assert(slant::spd_operator<decltype(g), vec<>>);
  vec<> const x = Eigen::Vector2d(1, 2);
  vec<> y(2);
  g.apply(x, y);
  CHECK(y == x);
}

}  // namespace projection_slant_test
