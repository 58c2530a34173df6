// SPDX-License-Identifier: MIT
#include <slant/sets/sets.hpp>
#include <slant/testing/archetypes.hpp>

#include <support/testing.hpp>

namespace blocks_test {

using slant::consecutive;
using slant::place;
using slant::planar;
using slant::detail::parameter_list;
using slant::detail::takes_parameters;

/// A client's block that names no scalar.
struct nameless {
  static constexpr int dimension = 2;
  Vector2d project(auto const& x) const { return x; }
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
  Vector3d x(-1, 1, -2);
  slant::project(slant::power(without_form{}, 3), x, x);
  CHECK(x == Vector3d(0, 1, 0));
  CHECK(slant::face_of(slant::power(without_form{}, 3), x).count(slant::block_state::free) == 1);
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

TEST_CASE("block_list: what counts as a list of parameters") {
  static_assert(parameter_list<std::vector<double>>);
  static_assert(parameter_list<Eigen::VectorXf>);
  static_assert(parameter_list<decltype(-VectorXd())>);
  static_assert(parameter_list<slant::testing::archetype::vector>);
  static_assert(!parameter_list<double>);
  static_assert(takes_parameters<slant::ball<2>, std::vector<double>>);
  static_assert(takes_parameters<slant::interval<>, double, VectorXd>);
  static_assert(!takes_parameters<slant::interval<>, VectorXd>);
  static_assert(!takes_parameters<slant::ball<2>, std::vector<const char*>>);
}

TEST_CASE("block_list: entries of all kinds of lists") {
  using slant::detail::parameter_at;
  CHECK(parameter_at(std::vector<double>{1, 2}, 1) == 2.0);
  CHECK(parameter_at(7.0, 5) == 7.0);
  VectorXd const g = Vector2d(3, 4);
  CHECK(parameter_at(-g, 1) == -4.0);
  CHECK(parameter_at(slant::testing::archetype::vector(g), 0) == 3.0);
  CHECK(slant::detail::parameter_count(1.0, g, 2.0, g) == 2);
}

TEST_CASE("block_list: copies of a block share it") {
  slant::detail::identical_blocks<slant::ball<2>> const blocks(slant::ball<2>{3.0}, 1000000);
  CHECK(blocks.size() == 1000000);
  CHECK(blocks[999999].radius() == 3.0);
  CHECK(&blocks[0] == &blocks[5]);
}

TEST_CASE("place: consecutive blocks own a segment, planar ones a component of each plane") {
  auto const c = slant::block_place<2, consecutive>(1, 3);
  CHECK(c.index() == 1);
  CHECK(c.size() == 2);
  CHECK(c.component(0) == 2);
  CHECK(c.component(1) == 3);
  auto const p = slant::block_place<2, planar>(1, 3);
  CHECK(p.index() == 1);
  CHECK(p.component(0) == 1);
  CHECK(p.component(1) == 4);
}

TEST_CASE("place: views read and write the block's part only") {
  VectorXd x(6);
  x << 0, 1, 2, 3, 4, 5;
  auto const p = slant::block_place<2, planar>(2, 3);
  CHECK(p.in(x) == Vector2d(2, 5));
  CHECK(p.value(x) == Vector2d(2, 5));
  auto view = p.in(x);
  view *= 10;
  p.put(x, Vector2d(7, 8));
  slant::block_place<2, consecutive>(0, 3).in(x).setConstant(-1);
  CHECK(x == (VectorXd(6) << -1, -1, 7, 3, 4, 8).finished());
  VectorXd const& unwritable = x;
  CHECK(p.in(unwritable) == Vector2d(7, 8));
  static_assert(!std::is_assignable_v<decltype(p.in(unwritable)(0)), double>);
}

TEST_CASE("place: views of strided parts, expressions and vectors that are no Eigen vectors") {
  VectorXd x(12);
  x << 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11;
  auto const p = slant::block_place<2, planar>(1, 3);
  Eigen::Map<VectorXd, 0, Eigen::InnerStride<2>> every_other(x.data(), 6);
  CHECK(p.in(every_other) == Vector2d(2, 8));
  auto const expression = every_other + every_other;
  CHECK(p.in(expression) == Vector2d(4, 16));
  slant::testing::archetype::vector v(x.head(6));
  p.in(v).setZero();
  CHECK(v.local() == (VectorXd(6) << 0, 0, 2, 3, 0, 5).finished());
}

TEST_CASE("place: nested places compose") {
  auto const outer = slant::block_place<3, planar>(1, 4);  // components 1, 5, 9
  auto const inner = place<2>(1, 1, 2);                    // the last two of three
  auto const both = outer.then(inner);
  static_assert(std::is_same_v<decltype(both), place<2, planar> const>);
  CHECK(both.index() == 2);
  CHECK(both.component(0) == 5);
  CHECK(both.component(1) == 9);
  auto const shifted = place<>(3, 10, 12).then(outer);
  CHECK(shifted.index() == 4);
  CHECK(shifted.component(0) == 11);
  CHECK(shifted.component(2) == 19);
  static_assert(
      std::is_same_v<decltype(place<>(0, 5, 4).then(place<2>(0, 0, 2))), place<2, consecutive>>);
}

}  // namespace blocks_test
