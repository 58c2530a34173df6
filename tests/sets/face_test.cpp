// SPDX-License-Identifier: MIT
#include <slant/sets/sets.hpp>
#include <slant/testing/archetypes.hpp>

#include <support/testing.hpp>
#include "counting_disc.hpp"

namespace face_test {

using namespace products;
using slant::block_state;
using slant::face_of;

using indices = std::vector<slant::index>;

TEST_CASE("face: a product of half lines and discs") {
  vec<> const g = Vector3d(1, 5, 0);
  auto const set = slant::cartesian(slant::half_lines(3), slant::discs(g));
  vec<> x(9);
  x << 1, 0, 2, 0.6, 0.8, 3, 3, 0, 0;
  auto face = face_of(set, x);
  CHECK(face.size() == 6);
  CHECK(face.dimension() == 9);
  CHECK(face.states() == std::vector{block_state::free, block_state::fixed, block_state::free,
                                     block_state::sliding, block_state::free, block_state::fixed});
  CHECK(face.count(block_state::free) == 3);
  CHECK(face.count(block_state::sliding) == 1);
  CHECK(face.count(block_state::fixed) == 2);
  CHECK(face.components() == indices{0, 2, 5, 6});

  vec<> const z = numbers(9, 1);
  vec<> kept = vec<>::Constant(9, std::numeric_limits<double>::quiet_NaN());
  face.keep(z, kept);
  for (int i : {0, 2, 5, 6}) CHECK(kept[i] == z[i]);
  for (int i : {1, 3, 4, 7, 8}) CHECK(kept[i] == 0.0);
}

TEST_CASE("face: assigning again reports changes, keeps everything in step, does not allocate") {
  vec<> const g = vec<>::Ones(10);
  auto const set = slant::cartesian(slant::half_lines(10), slant::discs<slant::planar>(g));
  vec<> const inner = vec<>::Constant(30, 0.5);
  vec<> corner = inner;
  corner[3] = 0;
  vec<> rim = inner;
  rim[14] = 1;  // disc 4: components 14 and 24
  rim[24] = 0;
  slant::face<> face;
  CHECK(face.size() == 0);
  CHECK(face.assign(set, inner));
  slant::testing::allocation_guard const guard;
  bool const same = face.assign(set, inner);
  bool const moved = face.assign(set, corner);
  bool const back = face.assign(set, inner);
  bool const slid = face.assign(set, rim);
  auto const allocations = guard.count();
  CHECK(allocations == 0);
  CHECK(!same);
  CHECK(moved);
  CHECK(back);
  CHECK(slid);
  CHECK(face.state(14) == block_state::sliding);
  CHECK(face.components().size() == 28);
  CHECK(face == face_of(set, rim));
  CHECK(!(face == face_of(set, inner)));
}

TEST_CASE("face: a set of the same size with another layout is another set") {
  vec<> const g = vec<>::Ones(2);
  vec<> const x = Eigen::Vector4d(1, 0, 0, 0);
  auto face = face_of(slant::discs(g), x);
  CHECK(face.components() == indices{2, 3});
  CHECK(face.assign(slant::discs<slant::planar>(g), x));
  CHECK(face.components() == indices{1, 3});
  CHECK(face.assign(slant::half_lines(4), x));
  CHECK(face.components() == indices{0});
  CHECK(face.size() == 4);
}

TEST_CASE("face: a single block, and a point whose state differs only between sliding and fixed") {
  auto const moving = face_of(slant::ball<2>{1.0}, Vector2d(1, 0));
  CHECK(moving.size() == 1);
  CHECK(moving.count(block_state::sliding) == 1);
  auto face = moving;
  CHECK(face.assign(slant::ball<2>{0.0}, Vector2d(0, 0)));
  CHECK(face.count(block_state::fixed) == 1);
  CHECK(face.components().empty());
  CHECK(!(face == moving));
}

TEST_CASE("face: the archetypes of a set and a vector") {
  slant::testing::archetype::separable_set const set(3);
  slant::testing::archetype::vector x(vec<>(Vector3d(1, 2, 3)));
  auto const face = face_of(set, x);
  CHECK(face.size() == 1);
  CHECK(face.components() == indices{0, 1, 2});
  slant::testing::archetype::vector y = x;
  face.keep_complement(x, y);
  CHECK(y.local() == Vector3d(0, 0, 0));
}

}  // namespace face_test
