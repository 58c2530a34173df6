// SPDX-License-Identifier: MIT
#include <slant/concepts/capabilities.hpp>
#include <slant/sets/slants.hpp>
#include <slant/testing/archetypes.hpp>

#include "counting_disc.hpp"
#include "support/allocation_guard.hpp"

#include <doctest/doctest.h>

#include <limits>

namespace block_diagonal_slant_test {

using namespace products;
using slant::block_diagonal_slant;

constexpr double quiet_nan = std::numeric_limits<double>::quiet_NaN();

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

TEST_CASE("block_diagonal_slant: apply, apply_add and diagonal in both layouts") {
  vec<> const x = Eigen::Vector4d(1, 2, 3, 4);
  auto const consecutive = example<slant::consecutive>();
  vec<> y = vec<>::Constant(4, quiet_nan);
  consecutive.apply(x, y);
  CHECK(y == Eigen::Vector4d(1, 1.75, 0.75, 1));
  consecutive.apply_add(2.0, x, y);
  CHECK(y == 3 * Eigen::Vector4d(1, 1.75, 0.75, 1));
  consecutive.diagonal(y);
  CHECK(y == Eigen::Vector4d(0.5, 0.75, 0.25, 0.25));

  auto const planar = example<slant::planar>();
  y.setConstant(quiet_nan);
  planar.apply(x, y);
  CHECK(y == Eigen::Vector4d(0.5 * 1 + 0.25 * 3, 0.5, 0.25 * 1 + 0.75 * 3, 1));
  planar.diagonal(y);
  CHECK(y == Eigen::Vector4d(0.5, 0.25, 0.75, 0.25));
  planar.visit([](auto const& g, auto const& p) {
    CHECK(g(0, 0) == (p.index() == 0 ? 0.5 : 0.25));
    CHECK(p.component(1) == p.index() + 2);
  });
}

TEST_CASE("block_diagonal_slant: without allocation, on matrices and on other vectors") {
  auto const g = example<slant::planar>();
  vec<> const x = numbers(4, 1);
  vec<> y(4);
  slant::testing::allocation_guard const guard;
  g.apply(x, y);
  auto const allocations = guard.count();
  CHECK(allocations == 0);
  Eigen::MatrixXd many(4, 2);
  many << x, 2 * x;
  Eigen::MatrixXd product(4, 2);
  g.apply(many, product);
  CHECK(product.col(0) == y);
  CHECK(product.col(1) == 2 * y);
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
  static_assert(slant::applies_to_many<general, Eigen::MatrixXd>);
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
  vec<> const x = numbers(2000, 2);
  vec<> y = vec<>::Constant(2000, quiet_nan);
  g.apply(x, y);
  CHECK(y == x);
  g.apply_add(3.0, x, y);
  CHECK(y == vec<>(x + 3 * x));
  g.diagonal(y);
  CHECK(y == vec<>::Ones(2000));
  CHECK(g.block(7) == Eigen::Matrix2d::Identity());
}

}  // namespace block_diagonal_slant_test
