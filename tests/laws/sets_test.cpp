// SPDX-License-Identifier: MIT
//
// Every block, at ordinary parameters and at the edges of what is legal, every image of blocks and
// every product keeps the laws of convex sets, in any scalar.
#include <slant/sets/sets.hpp>
#include <slant/testing/archetypes.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>
#include "oracle/precise.hpp"

namespace sets_test {

using slant::cartesian;
using slant::power;
using slant::rotated;
using slant::scaled;
using slant::shifted;
using slant::testing::check_set_laws;
using slant::testing::set_options;

VectorXd const radii = Vector3d(1, 0.3, 0);

/// Fewer points than a client would take, for there are many sets.
set_options few(unsigned seed = 1, double size = 1) {
  return {.seed = seed, .points = 24, .directions = 3, .size = size};
}

template <class... Sets>
void check(Sets const&... sets) {
  (check_set_laws(sets, few()), ...);
}

Eigen::Matrix2d turn(double angle) {
  Eigen::Matrix2d q;
  q << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  return q;
}

TEST_CASE("laws: half line and interval") {
  check(slant::half_line<>{}, slant::half_line<>{-1.5}, slant::half_line<>{-infinity},
        slant::interval<>{}, slant::interval<>{0.5, 2.0}, slant::interval<>{-infinity, 2.0},
        slant::interval<>{3.0, 3.0}, slant::symmetric_interval<>{0.25},
        slant::symmetric_interval<>{0.0});
  check_set_laws(slant::half_line<>{1e-9}, few(1, 1e-9));
}

TEST_CASE("laws: ball") {
  check(slant::ball<1>{0.7}, slant::ball<2>{}, slant::ball<2>{0.0}, slant::ball<2>{infinity},
        slant::ball<5>{2.0});
  check_set_laws(slant::ball<2>{1e3}, few(2, 1e3));
  check_set_laws(slant::ball<2>{1e-7}, few(3, 1e-7));
}

TEST_CASE("laws: ellipse") {
  auto flat = few();
  flat.interior = false;
  check(slant::ellipse<>{2.0, 1.0}, slant::ellipse<>{0.1, 2.0}, slant::ellipse<>{1.0, 1.0});
  check_set_laws(slant::ellipse<>{1.0, 0.02}, few(2));
  check_set_laws(slant::ellipse<>{1.0, 0.0}, flat);
  check_set_laws(slant::ellipse<>{1.0, infinity}, flat);
}

TEST_CASE("laws: second-order cone, point and free space") {
  check(slant::second_order_cone<2>{2.0}, slant::second_order_cone<3>{0.3},
        slant::second_order_cone<3>{0.0}, slant::second_order_cone<4>{0.7}, slant::point<2>{},
        slant::point<2>{Vector2d(1, -20)}, slant::free_space<2>{});
  check_set_laws(slant::second_order_cone<3>{1.0}, few(2));
}

TEST_CASE("laws: images of blocks, images of images, and their products") {
  check(shifted(slant::ball<2>{}, Vector2d(3, -4)),
        shifted(slant::second_order_cone<2>{0.5}, Vector2d(-1, 2)),
        scaled(2.5, slant::ellipse<>{1.0, 0.2}), rotated(slant::ellipse<>{1.0, 0.2}, turn(0.7)),
        rotated(slant::second_order_cone<2>{0.5}, turn(2.0)));
  auto const tilted =
      shifted(scaled(3.0, rotated(slant::ellipse<>{1.0, 0.2}, turn(0.7))), Vector2d(1, 2));
  check(tilted, cartesian(slant::half_line<>{}, power<slant::planar>(tilted, 2)));
  auto const product = cartesian(slant::half_lines(2), slant::discs<slant::planar>(radii));
  VectorXd const centre = VectorXd::LinSpaced(8, -2, 5);
  check(scaled(0.5, shifted(product, centre)));
}

TEST_CASE("laws: powers in both layouts, cartesian products of blocks and of products") {
  check(slant::discs(radii), slant::discs<slant::planar>(radii), slant::half_lines(radii),
        power<slant::planar>(slant::second_order_cone<3>{0.4}, 2),
        cartesian(slant::half_line<>{}, slant::ball<2>{2.0}),
        cartesian(slant::half_lines(2), slant::discs(radii), slant::free_components(1)));
  auto const node = cartesian(slant::half_line<>{0.5}, slant::ball<2>{}, slant::point<1>{});
  check(cartesian(slant::half_line<>{}, power<slant::planar>(node, 2)));
}

TEST_CASE("laws: on vectors that are no Eigen vectors") {
  auto const set = shifted(cartesian(slant::half_lines(2), slant::discs(radii)),
                           VectorXd(VectorXd::LinSpaced(8, -2, 5)));
  check_set_laws(set, slant::testing::archetype::vector(VectorXd::Zero(8)), few());
}

TEST_CASE_TEMPLATE("laws: a product in other scalars", S, float, oracle::float_50) {
  std::vector<S> const g{S(1), S(3) / S(10)};
  check_set_laws(cartesian(slant::half_lines<S>(1), slant::discs<slant::planar>(g)),
                 set_options{.points = 12, .directions = 2});
}

}  // namespace sets_test
