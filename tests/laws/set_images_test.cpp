// SPDX-License-Identifier: MIT
//
// Shifted, scaled and rotated sets keep the laws of convex sets.
#include <slant/sets/cartesian.hpp>
#include <slant/sets/contact_sets.hpp>
#include <slant/sets/ellipse.hpp>
#include <slant/sets/rotated.hpp>
#include <slant/sets/scaled.hpp>
#include <slant/sets/second_order_cone.hpp>
#include <slant/sets/shifted.hpp>
#include <slant/testing/set_laws.hpp>

#include <doctest/doctest.h>

#include <cmath>

namespace set_images_test {

using Eigen::Vector2d;
using slant::cartesian;
using slant::power;
using slant::rotated;
using slant::scaled;
using slant::shifted;
using slant::testing::check_set_laws;
using slant::testing::set_options;

Eigen::Matrix2d turn(double angle) {
  Eigen::Matrix2d q;
  q << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  return q;
}

set_options const few{.points = 24, .directions = 3};
Eigen::VectorXd const radii = Eigen::Vector3d(1, 0.3, 0);

TEST_CASE("laws: shifted, scaled and rotated blocks") {
  check_set_laws(shifted(slant::ball<2>{}, Vector2d(3, -4)), few);
  check_set_laws(shifted(slant::second_order_cone<2>{0.5}, Vector2d(-1, 2)), few);
  check_set_laws(scaled(2.5, slant::ellipse<>{1.0, 0.2}), few);
  check_set_laws(rotated(slant::ellipse<>{1.0, 0.2}, turn(0.7)), few);
  check_set_laws(rotated(slant::second_order_cone<2>{0.5}, turn(2.0)), few);
}

TEST_CASE("laws: images of images, and their products") {
  auto const tilted =
      shifted(scaled(3.0, rotated(slant::ellipse<>{1.0, 0.2}, turn(0.7))), Vector2d(1, 2));
  check_set_laws(tilted, few);
  check_set_laws(cartesian(slant::half_line<>{}, power<slant::planar>(tilted, 2)), few);
  auto const product = cartesian(slant::half_lines(2), slant::discs<slant::planar>(radii));
  Eigen::VectorXd const centre = Eigen::VectorXd::LinSpaced(8, -2, 5);
  check_set_laws(scaled(0.5, shifted(product, centre)), few);
}

}  // namespace set_images_test
