// SPDX-License-Identifier: MIT
#include <slant/sets/ball.hpp>
#include <slant/sets/cartesian.hpp>
#include <slant/sets/free_space.hpp>
#include <slant/sets/half_line.hpp>
#include <slant/sets/interval.hpp>
#include <slant/sets/point.hpp>
#include <slant/sets/power.hpp>

#include "counting_disc.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <vector>

namespace block_product_test {

using namespace products;
using slant::cartesian;

TEST_CASE("block_product: a product of blocks is a block") {
  auto const node = cartesian(slant::half_line<>{}, slant::ball<2>{2.0});
  using node_type = std::remove_cvref_t<decltype(node)>;
  static_assert(node_type::dimension == 3);
  static_assert(slant::set_block<node_type>);
  static_assert(std::is_same_v<decltype(node.project(Eigen::Vector3d())), Eigen::Vector3d>);
  Eigen::Vector3d const x(-1, 3, 4);
  Eigen::Vector3d const p = node.project(x);
  CHECK((p - Eigen::Vector3d(0, 1.2, 1.6)).norm() <= 1e-15);
  CHECK(node.contains(p));
  CHECK(!node.contains(x));
  CHECK(node.step_to_boundary(Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(-4, 1, 0)) == 0.25);
  CHECK(node.support(Eigen::Vector3d(-1, 3, 4)) == 10.0);
  Eigen::Vector3d in_place = x;
  node.project(in_place, in_place);
  CHECK(in_place == p);
  Eigen::Matrix3d const g = node.slant(x);
  CHECK(g(0, 0) == 0.0);
  CHECK(g.bottomRightCorner<2, 2>() == slant::ball<2>{2.0}.slant(x.tail<2>()));
  CHECK(g.row(0).tail<2>().isZero(0));
  CHECK(g.col(0).tail<2>().isZero(0));
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
  CHECK(set.inequality(x) == Eigen::Vector3d(-1.5, -1.5, 5 - 9));
  Eigen::Matrix<double, 4, 3> gradient;
  gradient << -1, 1, 0, 0, 0, 0, 0, 0, 2, 0, 0, 4;
  CHECK(set.inequality_gradient(x) == gradient);
  Eigen::Matrix4d hessian = Eigen::Matrix4d::Zero();
  hessian(2, 2) = hessian(3, 3) = 14;
  CHECK(set.inequality_hessian(x, Eigen::Vector3d(1, 2, 7)) == hessian);
  using with_point = decltype(cartesian(slant::half_line<>{}, slant::point<1>{}));
  static_assert(!slant::has_inequality_form<with_point, Eigen::Vector2d>);
  using unconstrained = decltype(cartesian(slant::free_space<1>{}, slant::free_space<2>{}));
  static_assert(slant::whole_space<unconstrained>);
}

}  // namespace block_product_test
