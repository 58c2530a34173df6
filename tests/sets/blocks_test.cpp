// SPDX-License-Identifier: MIT
#include <slant/sets/ball.hpp>
#include <slant/sets/blocks.hpp>
#include <slant/sets/face.hpp>
#include <slant/sets/free_space.hpp>
#include <slant/sets/half_line.hpp>
#include <slant/sets/power.hpp>
#include <slant/testing/archetypes.hpp>

#include <doctest/doctest.h>

#include <limits>

namespace blocks_test {

/// A client's block that names no scalar.
struct nameless {
  static constexpr int dimension = 2;
  Eigen::Vector2d project(auto const& x) const { return x; }
  bool contains(auto const&) const { return true; }
};

TEST_CASE("blocks: what types tell about a set") {
  using power_type = decltype(slant::power(slant::ball<2>{}, 1));
  static_assert(slant::static_dimension_of<slant::ball<3>> == 3);
  static_assert(slant::static_dimension_of<power_type> == Eigen::Dynamic);
  static_assert(std::is_same_v<slant::set_scalar_t<slant::ball<2, float>>, float>);
  static_assert(std::is_same_v<slant::set_scalar_t<nameless>, double>);
  static_assert(std::is_same_v<slant::point_t<slant::ball<2, float>>, Eigen::Vector2f>);
  static_assert(slant::set_block<nameless>);
  static_assert(slant::set_part<power_type> && !slant::set_block<power_type>);
  static_assert(!slant::set_part<slant::testing::archetype::convex_set>);  // not for Eigen vectors
  static_assert(slant::whole_space<slant::free_space<2>>);
  static_assert(!slant::whole_space<slant::ball<2>> && !slant::whole_space<nameless>);
}

/// A client's block that has no smooth inequality form, and says so.
struct without_form {
  static constexpr int dimension = 1;
  static constexpr int inequalities = 0;
  using point = Eigen::Matrix<double, 1, 1>;
  point project(point const& x) const { return x.cwiseMax(0.0); }
  bool contains(point const& x) const { return x[0] >= 0; }
  slant::block_state state(point const& x) const {
    return x[0] > 0 ? slant::block_state::free : slant::block_state::fixed;
  }
};

TEST_CASE("blocks: only a block that says whole_space is passed over") {
  static_assert(!slant::whole_space<without_form>);
  Eigen::Vector3d x(-1, 1, -2);
  slant::project(slant::power(without_form{}, 3), x, x);
  CHECK(x == Eigen::Vector3d(0, 1, 0));
  CHECK(slant::face_of(slant::power(without_form{}, 3), x).free_count() == 1);
}

TEST_CASE("blocks: a set that is no product is its own only block") {
  slant::ball<2> const disc{2.0};
  CHECK(slant::block_count(disc) == 1);
  int visits = 0;
  slant::visit_blocks(disc, [&](slant::ball<2> const& b, auto const& p) {
    ++visits;
    CHECK(b.radius() == 2.0);
    CHECK(p.index() == 0);
    CHECK(p.size() == 2);
    CHECK(p.component(1) == 1);
  });
  CHECK(visits == 1);
  slant::testing::archetype::convex_set const set(5);
  slant::visit_blocks(set, [&](auto const&, auto const& p) { CHECK(p.size() == 5); });
}

TEST_CASE("blocks: the smallest of several steps") {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double quiet_nan = std::numeric_limits<double>::quiet_NaN();
  slant::detail::smallest_step<double> all(0.0);
  CHECK(all.value() == infinity);
  CHECK(!all(3.0));
  CHECK(!all(infinity));
  CHECK(!all(2.0));
  CHECK(all.value() == 2.0);
  CHECK(all(0.0));
  slant::detail::smallest_step<double> enough(1.0);
  CHECK(!enough(1.0));
  CHECK(enough(0.5));
  slant::detail::smallest_step<double> spoilt(0.0);
  CHECK(!spoilt(1.0));
  CHECK(spoilt(quiet_nan));
  CHECK(spoilt.value() != spoilt.value());
}

}  // namespace blocks_test
