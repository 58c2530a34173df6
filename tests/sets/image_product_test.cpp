// SPDX-License-Identifier: MIT
#include <slant/sets/contact_sets.hpp>
#include <slant/sets/face.hpp>
#include <slant/sets/scaled.hpp>
#include <slant/sets/shifted.hpp>

#include "counting_disc.hpp"
#include "support/allocation_guard.hpp"

#include <doctest/doctest.h>

#include <limits>

namespace image_product_test {

using namespace products;
using slant::scaled;
using slant::shifted;

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
  vec<> const c = Eigen::Vector3d(1e6, 2e6, 3e6);
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
  auto const set = shifted(slant::half_lines(vec<>(Eigen::Vector2d(-infinity, 0))),
                           vec<>(Eigen::Vector2d(5, 5)));
  vec<> const x = Eigen::Vector2d(-1e300, -1);
  CHECK(slant::project(set, x) == Eigen::Vector2d(-1e300, 5));
  CHECK(set.support(vec<>(Eigen::Vector2d(-1, 0))) == infinity);
  CHECK(set.support(vec<>(Eigen::Vector2d(0, -2))) == -10.0);
}

}  // namespace image_product_test
