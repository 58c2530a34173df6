// SPDX-License-Identifier: MIT
//
// Products of blocks keep the laws of convex sets.
#include <slant/sets/cartesian.hpp>
#include <slant/sets/contact_sets.hpp>
#include <slant/sets/point.hpp>
#include <slant/sets/second_order_cone.hpp>
#include <slant/sets/shifted.hpp>
#include <slant/testing/archetypes.hpp>
#include <slant/testing/set_laws.hpp>

#include <doctest/doctest.h>

namespace set_products_test {

using slant::cartesian;
using slant::power;
using slant::shifted;
using slant::testing::check_set_laws;
using slant::testing::set_options;

set_options const few{.points = 24, .directions = 3};
Eigen::VectorXd const radii = Eigen::Vector3d(1, 0.3, 0);

TEST_CASE("laws: powers in both layouts") {
  check_set_laws(slant::discs(radii), few);
  check_set_laws(slant::discs<slant::planar>(radii), few);
  check_set_laws(slant::half_lines(radii), few);
  check_set_laws(power<slant::planar>(slant::second_order_cone<3>{0.4}, 2), few);
}

TEST_CASE("laws: cartesian products, blocks and not") {
  check_set_laws(cartesian(slant::half_line<>{}, slant::ball<2>{2.0}), few);
  check_set_laws(cartesian(slant::half_lines(2), slant::discs(radii), slant::free_components(1)),
                 few);
  auto const node = cartesian(slant::half_line<>{0.5}, slant::ball<2>{}, slant::point<1>{});
  check_set_laws(cartesian(slant::half_line<>{}, power<slant::planar>(node, 2)), few);
}

TEST_CASE("laws: on vectors that are no Eigen vectors") {
  auto const set = shifted(cartesian(slant::half_lines(2), slant::discs(radii)),
                           Eigen::VectorXd(Eigen::VectorXd::LinSpaced(8, -2, 5)));
  check_set_laws(set, slant::testing::archetype::vector(Eigen::VectorXd::Zero(8)), few);
}

}  // namespace set_products_test
