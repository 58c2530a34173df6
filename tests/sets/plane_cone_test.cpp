// SPDX-License-Identifier: MIT
#include <slant/sets/second_order_cone.hpp>

#include "oracle/precise.hpp"
#include "oracle/set_checks.hpp"

#include <slant/sets/contact_sets.hpp>
#include <slant/testing/set_laws.hpp>

#include <doctest/doctest.h>

#include <limits>

namespace plane_cone_test {

using Eigen::Vector2d;
using oracle::float_50;
using slant::block_state;
using cone = slant::plane_cone<>;

constexpr double ε = std::numeric_limits<double>::epsilon();

TEST_CASE("plane cone: laws, as a polyhedron and as a cone") {
  slant::testing::set_options const few{.points = 24, .directions = 3};
  slant::testing::check_set_laws(cone(0.7), few);
  slant::testing::check_set_laws(slant::second_order_cone<2>(0.7), few);
  auto flat = few;
  flat.interior = false;
  slant::testing::check_set_laws(cone(0.0), flat);
}

TEST_CASE("plane cone: the set of second_order_cone<2>, its slant at the kinks") {
  cone const set(2.0);
  CHECK(set.project(Vector2d(-1, 3)) == Vector2d(1, 2));
  CHECK(set.project(Vector2d(-2, -1)) == Vector2d(0, 0));
  CHECK(set.slant(Vector2d(1, 2)) == Eigen::Matrix2d::Identity());
  CHECK(set.slant(Vector2d(0, 0)) == Eigen::Matrix2d::Identity());
  CHECK(set.slant(Vector2d(-2, 1)) == Eigen::Matrix2d::Zero());
  Eigen::Matrix2d edge;
  edge << 0.2, -0.4, -0.4, 0.8;
  CHECK((set.slant(Vector2d(0, -1)) - edge).norm() <= 2 * ε);
  CHECK(cone(0.0).project(Vector2d(3, -5)) == Vector2d(3, 0));
  CHECK(cone(0.0).slant(Vector2d(3, 0)) == Vector2d(1, 0).asDiagonal().toDenseMatrix());
  CHECK(set.with(0.5).mu() == 0.5);
}

TEST_CASE("plane cone: linear inequalities and their derivatives") {
  using wide = Eigen::Matrix<float_50, 2, 1>;
  oracle::check_inequality_derivatives(slant::plane_cone<float_50>(float_50(0.75)),
                                       wide(float_50(2), float_50(-0.25)), float_50(1e-10));
  CHECK(cone(0.5).inequality(Vector2d(2, 3)) == Vector2d(2, -4));
  double const almost = 0.1 * 3;  // 0.30000000000000004
  CHECK(cone(0.1).inequality(Vector2d(3, almost))(0) ==
        double(float_50(almost) - float_50(0.1) * float_50(3)));
}

TEST_CASE("friction cones of many contacts, plane and spatial, by name") {
  Eigen::Vector3d const mu(0.5, 0, 2);
  auto const spatial = slant::friction_cones<3>(mu);
  CHECK(spatial.size() == 9);
  CHECK(spatial.block(2).mu() == 2.0);
  auto const plane = slant::friction_cones<2>(mu);
  CHECK(plane.size() == 6);
  Eigen::VectorXd const x = Eigen::VectorXd::LinSpaced(6, -3, 2);
  CHECK(slant::project(plane, x).head<2>() == cone(0.5).project(x.head<2>()));
}

}  // namespace plane_cone_test
