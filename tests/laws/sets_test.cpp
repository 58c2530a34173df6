// SPDX-License-Identifier: MIT
//
// Every block keeps the laws of convex sets, at ordinary parameters and at the edges of what is
// legal.
#include <slant/sets/ball.hpp>
#include <slant/sets/ellipse.hpp>
#include <slant/sets/free_space.hpp>
#include <slant/sets/half_line.hpp>
#include <slant/sets/interval.hpp>
#include <slant/sets/point.hpp>
#include <slant/sets/second_order_cone.hpp>
#include <slant/testing/set_laws.hpp>

#include <doctest/doctest.h>

#include <limits>

namespace sets_test {

using slant::testing::check_set_laws;
using slant::testing::set_options;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Fewer points than a client would take, for there are many sets.
set_options few(unsigned seed = 1, double size = 1) {
  return {.seed = seed, .points = 24, .directions = 3, .size = size};
}

TEST_CASE("laws: half line") {
  check_set_laws(slant::half_line<>{}, few());
  check_set_laws(slant::half_line<>{-1.5}, few());
  check_set_laws(slant::half_line<>{1e-9}, few(1, 1e-9));
  check_set_laws(slant::half_line<>{-infinity}, few());
}

TEST_CASE("laws: interval") {
  check_set_laws(slant::interval<>{}, few());
  check_set_laws(slant::interval<>{0.5, 2.0}, few());
  check_set_laws(slant::interval<>{-infinity, 2.0}, few());
  check_set_laws(slant::interval<>{3.0, 3.0}, few());
  check_set_laws(slant::symmetric_interval<>{0.25}, few());
  check_set_laws(slant::symmetric_interval<>{0.0}, few());
}

TEST_CASE("laws: ball") {
  check_set_laws(slant::ball<1>{0.7}, few());
  check_set_laws(slant::ball<2>{}, few());
  check_set_laws(slant::ball<2>{1e3}, few(2, 1e3));
  check_set_laws(slant::ball<2>{1e-7}, few(3, 1e-7));
  check_set_laws(slant::ball<2>{0.0}, few());
  check_set_laws(slant::ball<2>{infinity}, few());
  check_set_laws(slant::ball<5>{2.0}, few());
}

TEST_CASE("laws: ellipse") {
  auto flat = few();
  flat.interior = false;
  check_set_laws(slant::ellipse<>{2.0, 1.0}, few());
  check_set_laws(slant::ellipse<>{0.1, 2.0}, few());
  check_set_laws(slant::ellipse<>{1.0, 1.0}, few());
  check_set_laws(slant::ellipse<>{1.0, 0.02}, few(2));
  check_set_laws(slant::ellipse<>{1.0, 0.0}, flat);
  check_set_laws(slant::ellipse<>{1.0, infinity}, flat);
}

TEST_CASE("laws: second-order cone") {
  check_set_laws(slant::second_order_cone<2>{2.0}, few());
  check_set_laws(slant::second_order_cone<3>{0.3}, few());
  check_set_laws(slant::second_order_cone<3>{1.0}, few(2));
  check_set_laws(slant::second_order_cone<3>{0.0}, few());
  check_set_laws(slant::second_order_cone<4>{0.7}, few());
}

TEST_CASE("laws: point and free space") {
  check_set_laws(slant::point<2>{}, few());
  check_set_laws(slant::point<2>{Eigen::Vector2d(1, -20)}, few());
  check_set_laws(slant::free_space<2>{}, few());
}

}  // namespace sets_test
