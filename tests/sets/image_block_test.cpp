// SPDX-License-Identifier: MIT
#include <slant/sets/ball.hpp>
#include <slant/sets/cartesian.hpp>
#include <slant/sets/free_space.hpp>
#include <slant/sets/half_line.hpp>
#include <slant/sets/point.hpp>
#include <slant/sets/rotated.hpp>
#include <slant/sets/scaled.hpp>
#include <slant/sets/shifted.hpp>

#include <doctest/doctest.h>

#include <limits>
#include <vector>

namespace image_block_test {

using Vector1d = Eigen::Matrix<double, 1, 1>;
using Eigen::Vector2d;
using Eigen::Vector3d;
using slant::scaled;
using slant::shifted;

/// A client's block that can do the least.
struct plain {
  static constexpr int dimension = 2;
  Vector2d project(auto const& x) const { return x; }
  bool contains(auto const&) const { return true; }
};

TEST_CASE("image_block: images of images") {
  auto const set = shifted(scaled(2.0, slant::ball<2>{3.0}), Vector2d(10, 0));
  CHECK(set.project(Vector2d(20, 0)) == Vector2d(16, 0));
  auto const other = scaled(2.0, shifted(slant::ball<2>{3.0}, Vector2d(5, 0)));
  CHECK(other.project(Vector2d(20, 0)) == Vector2d(16, 0));
  CHECK(set.part().part().radius() == 3.0);
  CHECK(set.with(1.0).project(Vector2d(20, 0)) == Vector2d(12, 0));
  CHECK(set.slant(Vector2d(20, 0)) == slant::ball<2>{6.0}.slant(Vector2d(10, 0)));
}

TEST_CASE("image_block: the blocks of a product stay blocks if the map does not mix them") {
  auto const node = cartesian(slant::half_line<>{}, slant::ball<2>{});
  auto const moved = shifted(node, Vector3d(1, 2, 3));
  CHECK(moved.block_count() == 2);
  std::vector<Eigen::VectorXd> centres;
  moved.visit([&](auto const& block, auto const& p) {
    CHECK(p.index() == slant::index(centres.size()));
    centres.emplace_back(block.map().centre());
  });
  REQUIRE(centres.size() == 2);
  CHECK(centres[0] == Eigen::VectorXd::Constant(1, 1.0));
  CHECK(centres[1] == Vector2d(2, 3));
  auto const turned = rotated(node, Eigen::Matrix3d::Identity());
  CHECK(turned.block_count() == 1);
  static_assert(!slant::has_visit<decltype(turned)>);
}

TEST_CASE("image_block: what rounding may have lost in one block excuses nothing in another") {
  auto const quadrant = cartesian(slant::half_line<>{}, slant::half_line<>{});
  auto const check = [](auto const& set) {
    CHECK(set.contains(Vector2d(1e-6, 2e10)));
    CHECK(!set.contains(Vector2d(-1e-6, 2e10)));
    // In the block whose shift is large, its rounding still counts.
    CHECK(set.contains(set.project(Vector2d(-1, -1))));
    CHECK(!set.contains(Vector2d(-1e-6, 1e10)));
  };
  check(shifted(quadrant, Vector2d(0, 1e10)));
  check(scaled(2.0, shifted(quadrant, Vector2d(0, 5e9))));
  check(shifted(scaled(2.0, quadrant), Vector2d(0, 1e10)));
  check(scaled(2.0, quadrant));
  check(cartesian(slant::half_line<>{}, shifted(slant::half_line<>{}, Vector1d(1e10))));

  auto const moved = shifted(quadrant, Vector2d(0, 1e10));
  double const ulp = 0x1p-19;  // of 1e10
  CHECK(moved.contains(Vector2d(0, 1e10 - ulp)));
  CHECK(!moved.contains(Vector2d(-ulp, 1e10 - ulp)));
  CHECK(!moved.contains(Vector2d(std::numeric_limits<double>::quiet_NaN(), 2e10)));
}

TEST_CASE("image_block: has what its part has, no more") {
  using moved_space = decltype(shifted(slant::free_space<2>{}, Vector2d()));
  static_assert(slant::whole_space<moved_space>);
  using moved_point = decltype(shifted(slant::point<2>{}, Vector2d()));
  static_assert(!slant::has_inequality_form<moved_point, Vector2d>);
  static_assert(slant::has_support<moved_point, Vector2d>);
  using moved_plain = decltype(shifted(plain{}, Vector2d()));
  static_assert(slant::set_block<moved_plain>);
  static_assert(!slant::has_slant<moved_plain, Vector2d>);
  static_assert(!slant::has_state<moved_plain, Vector2d>);
  static_assert(!slant::has_step_to_boundary<moved_plain, Vector2d>);
  static_assert(!slant::has_support<moved_plain, Vector2d>);
  static_assert(!slant::has_inequality_form<moved_plain, Vector2d>);
  CHECK(shifted(slant::free_space<2>{}, Vector2d(1, 2)).project(Vector2d(3, 4)) == Vector2d(3, 4));
}

}  // namespace image_block_test
