// SPDX-License-Identifier: MIT
#include <slant/concepts/capabilities.hpp>
#include <slant/operators/sum.hpp>
#include <slant/sets/cartesian.hpp>
#include <slant/sets/slants.hpp>

#include "counting_disc.hpp"

#include <doctest/doctest.h>

#include <limits>

namespace direct_sum_slant_test {

using namespace products;
using bounds = slant::block_diagonal_slant<double, 1>;
using identity = slant::block_diagonal_slant<double, 1, slant::consecutive, true>;

bounds zero_one() {
  bounds g(2);
  g.assign(0, Eigen::Matrix<double, 1, 1>(0.0));
  g.assign(1, Eigen::Matrix<double, 1, 1>(1.0));
  return g;
}

TEST_CASE("direct_sum_slant: each part works on its own components") {
  slant::direct_sum_slant<bounds, identity> g(zero_one(), identity(1));
  CHECK(g.rows() == 3);
  CHECK(g.cols() == 3);
  vec<> const x = Eigen::Vector3d(5, 6, 7);
  vec<> y = vec<>::Constant(3, std::numeric_limits<double>::quiet_NaN());
  g.apply(x, y);
  CHECK(y == Eigen::Vector3d(0, 6, 7));
  g.apply_add(-1.0, x, y);
  CHECK(y == Eigen::Vector3d(0, 0, 0));
  g.diagonal(y);
  CHECK(y == Eigen::Vector3d(0, 1, 1));
  g.part<0>().assign(0, Eigen::Matrix<double, 1, 1>(1.0));
  g.apply(x, y);
  CHECK(y == x);
  Eigen::MatrixXd const many = Eigen::MatrixXd::Constant(3, 2, 2.0);
  Eigen::MatrixXd product(3, 2);
  g.apply(many, product);
  CHECK(product == many);
}

TEST_CASE("direct_sum_slant: keeps the laws that all parts have") {
  using mixed = slant::direct_sum_slant<bounds, identity>;
  static_assert(slant::psd_operator<mixed, vec<>>);
  static_assert(slant::declares_firmly_nonexpansive<mixed>);
  static_assert(!slant::spd_operator<mixed, vec<>>);
  static_assert(!slant::declares_projector<mixed>);
  using free = slant::direct_sum_slant<identity, identity>;
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
  using full = slant::direct_sum_slant<bounds, identity>;
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

}  // namespace direct_sum_slant_test
