// SPDX-License-Identifier: MIT
#include <slant/sets/ball.hpp>
#include <slant/sets/ellipse.hpp>
#include <slant/sets/half_line.hpp>
#include <slant/sets/interval.hpp>
#include <slant/sets/power.hpp>

#include "counting_disc.hpp"
#include "support/allocation_guard.hpp"
#include "support/message.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <vector>

namespace power_parameters_test {

using namespace products;
using slant::power;

TEST_CASE("power: copies of one block, and parameters that are lists or one number for all") {
  auto const copies = power(slant::half_line<>{2.0}, 3);
  CHECK(slant::project(copies, vec<>(vec<>::Zero(3))) == vec<>::Constant(3, 2.0));
  CHECK(power(slant::half_line<>{}, 0).size() == 0);
  std::vector<double> const upper{1, 2, 3};
  auto const boxes = power(slant::interval<>{}, 0.0, upper);
  CHECK(slant::project(boxes, vec<>(vec<>::Constant(3, 9.0))) == Eigen::Vector3d(1, 2, 3));
  CHECK(slant::project(boxes, vec<>(vec<>::Constant(3, -9.0))) == Eigen::Vector3d(0, 0, 0));
  auto const ellipses = power(slant::ellipse<>{1.0, 1.0}, vec<>(vec<>::Ones(2)), 2.0);
  CHECK(ellipses.block(1).project(Eigen::Vector2d(0, 9))(1) == doctest::Approx(2.0));
  auto const ints = power(slant::half_line<>{}, std::vector<int>{1, 2});
  CHECK(ints.block(1).lower() == 2.0);
}

TEST_CASE("power: update changes the parameters without allocation") {
  vec<> g = vec<>::Ones(50);
  auto set = power(slant::ball<2>{}, g);
  g.setConstant(2.0);
  slant::testing::allocation_guard const guard;
  set.update(g);
  auto const allocations = guard.count();
  CHECK(allocations == 0);
  CHECK(set.block(49).radius() == 2.0);
}

TEST_CASE("power: bad parameters are named with their block, and change nothing") {
  vec<> g = vec<>::Ones(5);
  auto set = power(slant::ball<2>{}, g);
  g[0] = 7;
  g[3] = -1;
  CHECK(test::complaint([&] { set.update(g); }) == "radius[3]: got -1, expected a number >= 0");
  CHECK(set.block(0).radius() == 1.0);
  CHECK(test::complaint([&] { static_cast<void>(power(slant::ball<2>{}, g)); }) ==
        "radius[3]: got -1, expected a number >= 0");
  g[3] = std::numeric_limits<double>::quiet_NaN();
  CHECK(test::complaint([&] { static_cast<void>(power(slant::ball<2>{}, g)); }) ==
        "radius[3]: got nan, expected a number >= 0");
  vec<> const l = vec<>::Constant(3, 2.0);
  CHECK(test::complaint([&] {
          static_cast<void>(power(slant::interval<>{}, l, vec<>(-l)));
        }).starts_with("l[0]: got 2, expected a number <= u"));
  CHECK(test::complaint([&] { static_cast<void>(power(slant::interval<>{}, l, g)); }) ==
        "length of parameter list 2: got 5, expected 3, the length of the list before it");
  CHECK(test::complaint([&] { set.update(l); }) ==
        "number of parameters: got 3, expected 5, the number of blocks");
  CHECK(test::complaint([&] { static_cast<void>(power(slant::half_line<>{}, -1)); }) ==
        "number of blocks: got -1, expected a number >= 0");
}

}  // namespace power_parameters_test
