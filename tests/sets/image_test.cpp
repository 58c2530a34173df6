// SPDX-License-Identifier: MIT
#include <slant/sets/sets.hpp>

#include <support/testing.hpp>
#include "counting_disc.hpp"

namespace image_test {

using Vector1d = Eigen::Matrix<double, 1, 1>;
using slant::scaled;
using slant::shifted;
using namespace products;
using slant::block_state;
using slant::detail::contains_within;
using slant::detail::state_within;

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
  std::vector<VectorXd> centres;
  moved.visit([&](auto const& block, auto const& p) {
    CHECK(p.index() == slant::index(centres.size()));
    centres.emplace_back(block.map().centre());
  });
  REQUIRE(centres.size() == 2);
  CHECK(centres[0] == VectorXd::Constant(1, 1.0));
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

/// A client's set of run-time dimension that is no product: the vectors with mean value <= 1.
struct small_mean {
  slant::index n;
  slant::index size() const { return n; }
  void project(auto const& x, auto& y) const {
    double const excess = x.sum() / double(n) - 1;
    y = x;
    if (excess > 0) y.array() -= excess;
  }
  bool contains(auto const& x) const { return x.sum() <= double(n); }
};

TEST_CASE("image_product: of a set that is no product") {
  vec<> const c = Vector3d(1e6, 2e6, 3e6);
  auto const set = shifted(small_mean{3}, c);
  vec<> const x = c + numbers(3, 1) + vec<>::Constant(3, 10.0);
  vec<> const p = slant::project(set, x);
  CHECK((p - c).mean() == doctest::Approx(1.0));
  CHECK(set.contains(p));  // although p − c has lost six digits
  CHECK(!set.contains(x));
  static_assert(!slant::has_visit<decltype(set)>);
  static_assert(!slant::has_slant<decltype(set), vec<>>);
}

TEST_CASE("image_product: images of images, in place and without allocation") {
  vec<> const c = numbers(6, 2);
  auto const product = slant::discs(vec<>(vec<>::Ones(3)));
  auto const inner = shifted(product, c);
  auto const set = scaled(2.0, inner);
  auto const twin = shifted(slant::discs(vec<>(vec<>::Constant(3, 2.0))), vec<>(2 * c));
  vec<> const x = numbers(6, 3) * 3;
  vec<> y = x;
  slant::testing::allocation_guard const guard;
  set.project(y, y);
  bool const inside = set.contains(y);
  double const step = set.step_to_boundary(y, x, 0.5);
  auto const allocations = guard.count();
  CHECK(allocations == 0);
  CHECK(inside);
  CHECK(step >= 0);
  CHECK((y - slant::project(twin, x)).norm() <= 1e-14);
  CHECK(set.support(x) == doctest::Approx(twin.support(x)));
  CHECK(slant::face_of(set, y) == slant::face_of(twin, y));
  CHECK(set.block_count() == 3);
  CHECK(&set.part() == &inner);
}

TEST_CASE("image_product: infinite bounds stay infinite") {
  double const infinity = std::numeric_limits<double>::infinity();
  auto const set = shifted(slant::half_lines(vec<>(Vector2d(-infinity, 0))), vec<>(Vector2d(5, 5)));
  vec<> const x = Vector2d(-1e300, -1);
  CHECK(slant::project(set, x) == Vector2d(-1e300, 5));
  CHECK(set.support(vec<>(Vector2d(-1, 0))) == infinity);
  CHECK(set.support(vec<>(Vector2d(0, -2))) == -10.0);
}

TEST_CASE("rounding_reach: membership within a distance") {
  slant::ball<2> const disc{1.0};
  CHECK(contains_within(disc, Vector2d(1.0005, 0), 1e-3));
  CHECK(!contains_within(disc, Vector2d(1.002, 0), 1e-3));
  CHECK(contains_within(disc, Vector2d(0.5, 0), 0.0));
  double const infinity = std::numeric_limits<double>::infinity();
  CHECK(!contains_within(disc, Vector2d(infinity, 0), infinity));
  CHECK(!contains_within(disc, Vector2d(std::numeric_limits<double>::quiet_NaN(), 0), 1.0));
}

TEST_CASE("rounding_reach: the most confined state within a distance") {
  slant::ball<2> const disc{1.0};
  CHECK(state_within(disc, Vector2d(0.9, 0), 0.0) == block_state::free);
  CHECK(state_within(disc, Vector2d(0.9, 0), 0.05) == block_state::free);
  CHECK(state_within(disc, Vector2d(0.9, 0), 0.2) == block_state::sliding);
  CHECK(state_within(disc, Vector2d(1.05, 0), 0.2) == block_state::sliding);
  using number = Eigen::Matrix<double, 1, 1>;
  slant::half_line<> const line{0.0};
  CHECK(state_within(line, number(1e-9), 1e-8) == block_state::fixed);
  CHECK(state_within(line, number(1e-7), 1e-8) == block_state::free);
  slant::second_order_cone<2> const cone{1.0};
  CHECK(state_within(cone, Vector2d(1e-9, 0), 1e-8) == block_state::fixed);
  CHECK(state_within(cone, Vector2d(1, 1 - 1e-9), 1e-8) == block_state::sliding);
}

}  // namespace image_test
