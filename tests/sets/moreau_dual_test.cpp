// SPDX-License-Identifier: MIT
#include <slant/sets/moreau_dual.hpp>

#include "oracle/hard_points.hpp"

#include <slant/sets/dual_cone.hpp>
#include <slant/testing/set_laws.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

namespace moreau_dual_test {

using Eigen::Vector3d;

constexpr double ε = std::numeric_limits<double>::epsilon();

TEST_CASE("moreau_dual: of a round cone it is dual_cone") {
  oracle::number_source<double> source(1);
  for (int i = 0; i < 200; ++i) {
    double const μ = source.positive_of_size(-2, 2);
    slant::moreau_dual<slant::second_order_cone<3>> const set(slant::second_order_cone<3>{μ});
    Vector3d const x = source.of_size(-150, 150) * source.direction<3>();
    slant::dual_cone<3> const same(μ);
    CHECK((set.project(x) - same.project(x)).norm() <= 4 * ε * x.norm());
    CHECK((set.slant(x) - same.slant(x)).norm() <= 16 * ε);
    CHECK(set.contains(set.project(x)));
  }
}

TEST_CASE("moreau_dual: of the elliptic cone, {‖(μ₁u₁, μ₂u₂)‖ <= u_n}") {
  auto const set = slant::dual(slant::elliptic_cone<>(2.0, 0.5));
  Vector3d const on_mantle(5, 1.5, 8);
  CHECK(set.contains(on_mantle));
  CHECK_FALSE(set.contains(Vector3d(4.99, 1.5, 8)));
  CHECK(set.project(on_mantle) == on_mantle);
  CHECK(set.slant(on_mantle) == Eigen::Matrix3d::Identity());
  CHECK(set.project(Vector3d(-1, 2, 0)) == Vector3d(0, 0, 0));  // −K
  CHECK(set.support(Vector3d(-1, 2, 0)) == 0);
  CHECK(slant::dual(set).mu(1) == 0.5);
  oracle::number_source<double> source(2);
  for (int i = 0; i < 200; ++i) {
    Vector3d const x = source.of_size(-3, 3) * source.direction<3>();
    Vector3d const p = set.project(x);
    CHECK(std::hypot(2 * p(1), 0.5 * p(2)) - p(0) <= 8 * ε * x.norm());
    CHECK(std::abs(p.dot(x - p)) <= 16 * ε * x.squaredNorm());
  }
  slant::testing::set_options const few{.points = 16, .directions = 3};
  slant::testing::check_set_laws(set, few);
  slant::testing::check_set_laws(slant::dual(slant::elliptic_cone<>(0.5, 0.0)), few);
}

}  // namespace moreau_dual_test
