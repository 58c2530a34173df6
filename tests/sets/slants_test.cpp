// SPDX-License-Identifier: MIT
#include <slant/operators/sum.hpp>
#include <slant/sets/sets.hpp>
#include <slant/testing/archetypes.hpp>
#include <slant/testing/laws.hpp>

#include <support/dense_of.hpp>
#include <support/testing.hpp>
#include "counting_disc.hpp"

namespace slants_test {

using namespace products;
using slant::block_diagonal_slant;
using bounds = slant::block_diagonal_slant<double, 1>;
using whole = slant::block_diagonal_slant<double, 1, slant::consecutive, true>;

/// Two blocks that are easy to tell apart, in a given layout.
template <class Layout>
block_diagonal_slant<double, 2, Layout> example() {
  block_diagonal_slant<double, 2, Layout> g(2);
  Eigen::Matrix2d a;
  a << 0.5, 0.25, 0.25, 0.75;
  g.assign(0, a);
  g.assign(1, Eigen::Matrix2d::Identity() / 4);
  return g;
}

TEST_CASE("block_diagonal_slant: the blocks are where the layout has them") {
  MatrixXd const expected{{0.5, 0.25, 0, 0}, {0.25, 0.75, 0, 0}, {0, 0, 0.25, 0}, {0, 0, 0, 0.25}};
  auto const consecutive = example<slant::consecutive>();
  CHECK(test::dense_of(consecutive) == expected);
  slant::testing::check_operator_laws(consecutive);
  auto const planar = example<slant::planar>();
  std::array const places{0, 2, 1, 3};
  CHECK(test::dense_of(planar) == MatrixXd(expected(places, places)));
  slant::testing::check_operator_laws(planar);
  planar.visit([](auto const& g, auto const& p) {
    CHECK(g(0, 0) == (p.index() == 0 ? 0.5 : 0.25));
    CHECK(p.component(1) == p.index() + 2);
  });
}

TEST_CASE("block_diagonal_slant: without allocation, and on other vectors") {
  auto const g = example<slant::planar>();
  vec<> const x = numbers(4, 1);
  vec<> y(4);
  CHECK(test::allocations_of([&] { g.apply(x, y); }) == 0);
  slant::testing::archetype::vector const v(x);
  slant::testing::archetype::vector w(vec<>(vec<>::Constant(4, quiet_nan)));
  g.apply(v, w);
  CHECK(w.local() == y);
}

TEST_CASE("block_diagonal_slant: declares its laws and has what operators have") {
  using general = block_diagonal_slant<double, 2>;
  static_assert(slant::self_adjoint_operator<general, vec<>>);
  static_assert(slant::psd_operator<general, vec<>>);
  static_assert(!slant::spd_operator<general, vec<>>);
  static_assert(slant::declares_firmly_nonexpansive<general>);
  static_assert(slant::has_accumulate<general, vec<>>);
  static_assert(slant::has_diagonal<general, vec<>>);
  static_assert(slant::has_adjoint<general, vec<>>);
  static_assert(slant::applies_to_many<general, MatrixXd>);
}

TEST_CASE("block_diagonal_slant: blocks without constraint store nothing") {
  using identity = block_diagonal_slant<double, 2, slant::consecutive, true>;
  static_assert(slant::spd_operator<identity, vec<>>);
  static_assert(slant::declares_projector<identity>);
  slant::testing::allocation_guard const guard;
  identity const g(1000);
  auto const allocations = guard.count();
  CHECK(allocations == 0);
  CHECK(g.rows() == 2000);
  CHECK(g.block(7) == Eigen::Matrix2d::Identity());
  CHECK(test::dense_of(identity(2)).isIdentity(0));
  slant::testing::check_operator_laws(identity(2));
}

bounds zero_one() {
  bounds g(2);
  g.assign(0, Eigen::Matrix<double, 1, 1>(0.0));
  g.assign(1, Eigen::Matrix<double, 1, 1>(1.0));
  return g;
}

TEST_CASE("direct_sum_slant: each part works on its own components") {
  slant::direct_sum_slant<bounds, whole> g(zero_one(), whole(1));
  CHECK(test::dense_of(g) == MatrixXd(Vector3d(0, 1, 1).asDiagonal()));
  slant::testing::check_operator_laws(g);
  g.part<0>().assign(0, Eigen::Matrix<double, 1, 1>(1.0));
  CHECK(test::dense_of(g).isIdentity(0));
}

TEST_CASE("direct_sum_slant: keeps the laws that all parts have") {
  using mixed = slant::direct_sum_slant<bounds, whole>;
  static_assert(slant::psd_operator<mixed, vec<>>);
  static_assert(slant::declares_firmly_nonexpansive<mixed>);
  static_assert(!slant::spd_operator<mixed, vec<>>);
  static_assert(!slant::declares_projector<mixed>);
  using free = slant::direct_sum_slant<whole, whole>;
  static_assert(slant::spd_operator<free, vec<>>);
  static_assert(slant::declares_projector<free>);
}

/// y = x on three components and nothing else: no apply_add, no diagonal.
struct bare_slant {
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::firmly_nonexpansive>;
  [[nodiscard]] slant::index rows() const { return 3; }
  [[nodiscard]] slant::index cols() const { return 3; }
  void apply(auto const& x, auto& y) const { y = x; }
};

TEST_CASE("direct_sum_slant: can do what all parts can, and claims no more") {
  using full = slant::direct_sum_slant<bounds, whole>;
  static_assert(slant::has_accumulate<full, vec<>> && slant::has_diagonal<full, vec<>>);
  using partial = slant::direct_sum_slant<bare_slant, bounds>;
  static_assert(slant::linear_operator<partial, vec<>>);
  static_assert(!slant::has_accumulate<partial, vec<>>);
  static_assert(!slant::has_diagonal<partial, vec<>>);
  struct whole_vectors_only : bare_slant {
    void apply(vec<> const& x, vec<>& y) const { y = x; }
  };
  static_assert(slant::linear_operator<whole_vectors_only, vec<>>);
  static_assert(
      !slant::linear_operator<slant::direct_sum_slant<whole_vectors_only, bounds>, vec<>>);

  // So compositions take the way that works.
  auto const twice =
      slant::sum(partial(bare_slant{}, zero_one()), partial(bare_slant{}, zero_one()));
  vec<> const x = numbers(5, 1);
  vec<> y(5);
  slant::apply(twice, x, y);
  vec<> expected = 2 * x;
  expected[3] = 0;
  CHECK(y == expected);
}

TEST_CASE("projection_slant: a block gives an operator with one block") {
  slant::ball<2> const disc{1.0};
  vec<> const x = Vector2d(3, 4);
  vec<> const h = Vector2d(1, 2);
  auto g = slant::projection_slant(disc, x);
  static_assert(slant::psd_operator<decltype(g), vec<>>);
  vec<> y(2);
  g.apply(h, y);
  CHECK((y - disc.slant(x) * h).norm() <= 1e-16);
  CHECK(test::allocations_of([&] { slant::projection_slant(disc, vec<>::Zero(2), g); }) == 0);
  g.apply(h, y);
  CHECK(y == h);
}

TEST_CASE("projection_slant: the whole space gives the identity without storage") {
  auto const g = slant::projection_slant(slant::free_space<2>{}, vec<>(vec<>::Zero(2)));
  static_assert(slant::spd_operator<decltype(g), vec<>>);
  vec<> const x = Vector2d(1, 2);
  vec<> y(2);
  g.apply(x, y);
  CHECK(y == x);
}

}  // namespace slants_test
