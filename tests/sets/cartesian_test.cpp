// SPDX-License-Identifier: MIT
#include <slant/sets/sets.hpp>

#include <support/testing.hpp>
#include "counting_disc.hpp"

namespace cartesian_test {

using namespace products;
using slant::cartesian;
using slant::power;

/// The vectors below 1, of any length. No capability, no static dimension.
struct bounded_above {
  slant::index n;
  slant::index size() const { return n; }
  void project(auto const& x, auto& y) const { y = x.cwiseMin(1.0); }
  bool contains(auto const& x) const { return (x.array() <= 1.0).all(); }
};

TEST_CASE("cartesian: parts follow one another") {
  vec<> const g = Vector3d(1, 2, 0);
  auto const set = cartesian(power(slant::half_line<>{}, 3), power(slant::ball<2>{}, g));
  CHECK(set.size() == 9);
  CHECK(set.block_count() == 6);
  vec<> const x = (vec<>(9) << -1, 2, -3, 3, 4, 3, 4, 3, 4).finished();
  vec<> const expected = (vec<>(9) << 0, 2, 0, 0.6, 0.8, 1.2, 1.6, 0, 0).finished();
  vec<> y = vec<>::Constant(9, std::numeric_limits<double>::quiet_NaN());
  CHECK(test::allocations_of([&] { set.project(x, y); }) == 0);
  CHECK((y - expected).norm() <= 1e-15);
  vec<> z = x;
  set.project(z, z);
  CHECK(z == y);
  CHECK(set.contains(y));
  CHECK(!set.contains(x));
  CHECK(!set.contains(vec<>(x.head(8))));
}

TEST_CASE("cartesian: visit reaches the innermost blocks, numbered through") {
  vec<> const g = Vector2d(1, 2);
  auto const node = cartesian(slant::half_line<>{}, slant::ball<2>{3.0});
  auto const set = cartesian(power(slant::free_space<1>{}, 2), power(node, 2),
                             power<slant::planar>(slant::ball<2>{}, g), slant::ball<2>{5.0});
  CHECK(set.size() == 2 + 6 + 4 + 2);
  CHECK(set.block_count() == 2 + 4 + 2 + 1);
  std::vector<std::vector<slant::index>> places;
  std::vector<double> radii;
  set.visit([&](auto const& block, auto const& p) {
    CHECK(p.index() == slant::index(places.size()));
    places.emplace_back();
    for (slant::index j = 0; j < p.size(); ++j) places.back().push_back(p.component(j));
    if constexpr (requires { block.radius(); }) radii.push_back(block.radius());
  });
  CHECK(places == std::vector<std::vector<slant::index>>{
                      {0}, {1}, {2}, {3, 4}, {5}, {6, 7}, {8, 10}, {9, 11}, {12, 13}});
  CHECK(radii == std::vector<double>{3, 3, 1, 2, 5});
}

TEST_CASE("cartesian: offsets are constants as far as the types tell") {
  auto const set = cartesian(slant::ball<2>{}, slant::half_line<>{}, power(slant::half_line<>{}, 4),
                             slant::ball<3>{});
  using set_type = std::remove_cvref_t<decltype(set)>;
  static_assert(set_type::static_offset<0>() == 0);
  static_assert(set_type::static_offset<1>() == 2);
  static_assert(set_type::static_offset<2>() == 3);
  static_assert(set_type::static_offset<3>() == -1);
  CHECK(set.offset<3>() == 7);
  CHECK(set.offset<4>() == 10);
  static_assert(set_type::part_count == 4);
  static_assert(!slant::has_static_dimension<set_type>);
}

TEST_CASE("cartesian: early exit of the step skips later parts") {
  auto const set =
      cartesian(power(slant::half_line<>{}, 2), power(counting_disc{}, vec<>(vec<>::Ones(3))));
  vec<> const x = vec<>::Zero(8);
  vec<> d = vec<>::Ones(8);
  d[1] = -1;
  counting_disc::questions = 0;
  CHECK(set.step_to_boundary(x, d) == 0.0);
  CHECK(counting_disc::questions == 0);
}

TEST_CASE("cartesian: products passed as lvalues are referenced, rvalues and blocks are owned") {
  auto friction = power(slant::ball<2>{}, vec<>(vec<>::Ones(2)));
  auto const set = cartesian(friction, power(slant::half_line<>{}, 1));
  friction.update(vec<>(vec<>::Constant(2, 3.0)));
  CHECK(&set.part<0>() == &friction);
  CHECK(set.part<0>().block(1).radius() == 3.0);
  auto const owned = [] {
    auto const block = slant::half_line<>{2.0};
    return cartesian(block, power(slant::ball<2>{4.0}, 1));
  }();
  CHECK(owned.part<0>().lower() == 2.0);
  CHECK(owned.part<1>().block(0).radius() == 4.0);
}

TEST_CASE("cartesian: a part may be any convex set") {
  auto const set = cartesian(bounded_above{2}, slant::half_line<>{});
  vec<> const x = Vector3d(2, 0, -1);
  CHECK(slant::project(set, x) == Vector3d(1, 0, 0));
  CHECK(!set.contains(x));
  static_assert(!slant::has_slant<decltype(set), vec<>>);
  static_assert(!slant::has_step_to_boundary<decltype(set), vec<>>);
  static_assert(!slant::has_support<decltype(set), vec<>>);
}

TEST_CASE("block_product: a product of blocks is a block") {
  auto const node = cartesian(slant::half_line<>{}, slant::ball<2>{2.0});
  using node_type = std::remove_cvref_t<decltype(node)>;
  static_assert(node_type::dimension == 3);
  static_assert(slant::set_block<node_type>);
  static_assert(std::is_same_v<decltype(node.project(Vector3d())), Vector3d>);
}

TEST_CASE("block_product: powers of it, with blocks as parameters, in both layouts") {
  std::vector<slant::half_line<>> const lines{slant::half_line<>{0.0}, slant::half_line<>{1.0}};
  std::vector<slant::ball<2>> const discs{slant::ball<2>{1.0}, slant::ball<2>{2.0}};
  auto const shape = cartesian(slant::half_line<>{}, slant::ball<2>{});
  vec<> const x = (vec<>(6) << -1, 3, 4, -1, 3, 4).finished();
  auto const nodes = slant::power(shape, lines, discs);
  CHECK(nodes.block_count() == 4);
  CHECK((slant::project(nodes, x) - (vec<>(6) << 0, 0.6, 0.8, 1, 1.2, 1.6).finished()).norm() <=
        1e-15);
  auto const planes = slant::power<slant::planar>(shape, lines, discs);
  vec<> const z = (vec<>(6) << -1, -1, 3, 3, 4, 4).finished();
  CHECK((slant::project(planes, z) - (vec<>(6) << 0, 1, 0.6, 1.2, 0.8, 1.6).finished()).norm() <=
        1e-15);
}

TEST_CASE("block_product: the inequalities of all parts") {
  auto const set =
      cartesian(slant::interval<>{-1.0, 2.0}, slant::free_space<1>{}, slant::ball<2>{3.0});
  using set_type = std::remove_cvref_t<decltype(set)>;
  static_assert(set_type::inequalities == 3);
  Eigen::Vector4d const x(0.5, 9, 1, 2);
  CHECK(set.inequality(x) == Vector3d(-1.5, -1.5, 5 - 9));
  Eigen::Matrix<double, 4, 3> gradient;
  gradient << -1, 1, 0, 0, 0, 0, 0, 0, 2, 0, 0, 4;
  CHECK(set.inequality_gradient(x) == gradient);
  Eigen::Matrix4d hessian = Eigen::Matrix4d::Zero();
  hessian(2, 2) = hessian(3, 3) = 14;
  CHECK(set.inequality_hessian(x, Vector3d(1, 2, 7)) == hessian);
  using with_point = decltype(cartesian(slant::half_line<>{}, slant::point<1>{}));
  static_assert(!slant::has_inequality_form<with_point, Vector2d>);
  using unconstrained = decltype(cartesian(slant::free_space<1>{}, slant::free_space<2>{}));
  static_assert(slant::whole_space<unconstrained>);
}

}  // namespace cartesian_test
