// SPDX-License-Identifier: MIT
#include <slant/sets/blocks.hpp>
#include <slant/testing/archetypes.hpp>

#include <doctest/doctest.h>

#include <type_traits>

namespace place_test {

using slant::consecutive;
using slant::place;
using slant::planar;

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
  Eigen::VectorXd x(6);
  x << 0, 1, 2, 3, 4, 5;
  auto const p = slant::block_place<2, planar>(2, 3);
  CHECK(p.in(x) == Eigen::Vector2d(2, 5));
  CHECK(p.value(x) == Eigen::Vector2d(2, 5));
  auto view = p.in(x);
  view *= 10;
  p.put(x, Eigen::Vector2d(7, 8));
  slant::block_place<2, consecutive>(0, 3).in(x).setConstant(-1);
  CHECK(x == (Eigen::VectorXd(6) << -1, -1, 7, 3, 4, 8).finished());
  Eigen::VectorXd const& unwritable = x;
  CHECK(p.in(unwritable) == Eigen::Vector2d(7, 8));
  static_assert(!std::is_assignable_v<decltype(p.in(unwritable)(0)), double>);
}

TEST_CASE("place: views of strided parts, expressions and vectors that are no Eigen vectors") {
  Eigen::VectorXd x(12);
  x << 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11;
  auto const p = slant::block_place<2, planar>(1, 3);
  Eigen::Map<Eigen::VectorXd, 0, Eigen::InnerStride<2>> every_other(x.data(), 6);
  CHECK(p.in(every_other) == Eigen::Vector2d(2, 8));
  auto const expression = every_other + every_other;
  CHECK(p.in(expression) == Eigen::Vector2d(4, 16));
  slant::testing::archetype::vector v(x.head(6));
  p.in(v).setZero();
  CHECK(v.local() == (Eigen::VectorXd(6) << 0, 0, 2, 3, 0, 5).finished());
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

TEST_CASE("place: composing is associative") {
  auto const a = place<>(2, 7, 12);
  auto const b = slant::block_place<4, planar>(1, 3, 2);
  auto const c = place<2>(1, 2, 2);
  auto const left = a.then(b).then(c);
  auto const right = a.then(b.then(c));
  static_assert(std::is_same_v<decltype(left), decltype(right)>);
  CHECK(left.index() == right.index());
  for (int j = 0; j < 2; ++j) CHECK(left.component(j) == right.component(j));
}

}  // namespace place_test
