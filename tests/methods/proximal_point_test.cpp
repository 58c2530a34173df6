// SPDX-License-Identifier: MIT
#include <slant/methods/proximal_point.hpp>

#include "support/allocation_guard.hpp"

#include <slant/iteration/solve.hpp>
#include <slant/iteration/stopping.hpp>

#include <doctest/doctest.h>
#include <Eigen/LU>

#include <cmath>

namespace proximal_point_test {

using vector = Eigen::Vector3d;

/// (A + αI) x = b + α c, exactly; fails where α < least.
struct linear {
  Eigen::Matrix3d A;
  vector b;
  double least = 0;
  slant::index steps = 1;

  slant::proximal_inner_report operator()(vector const& c, double const& α, vector& x) const {
    if (α < least) return {.solved = false, .accept = false, .steps = steps};
    x = (A + α * Eigen::Matrix3d::Identity()).inverse() * (b + α * c);
    return {.solved = true, .accept = false, .steps = steps};
  }
};

/// Rank 2: x₀ + x₁ and x₂ are determined.
linear singular() {
  linear p;
  p.A << 1, 1, 0, 1, 1, 0, 0, 0, 3;
  p.b << 2, 2, 6;
  return p;
}

static_assert(slant::iterative_method<slant::proximal_point<linear>, vector>);

TEST_CASE("proximal point: a singular system, the kernel's part of the start is kept") {
  slant::proximal_point method(singular(),
                               slant::proximal_point_options<double>{.first = 1, .smallest = 1e-4});
  auto s = method.start(vector(5, 1, -4));
  slant::testing::allocation_guard guard;
  for (int k = 0; k < 12; ++k) method.step(s);
  auto const allocations = guard.count();
  CHECK(allocations == 0);
  CHECK((s.x - vector(3, -1, 2)).norm() <= 1e-10);  // 5 − 1 = 4 = 3 − (−1)
  CHECK(s.iteration == 12);
  CHECK(s.work.inner_iterations == 12);
  CHECK(s.failures == 0);
  CHECK(s.step_norm <= 1e-10);
  CHECK(s.status == slant::status::running);
}

TEST_CASE("proximal point: α follows the inner solver") {
  slant::proximal_point_options<double> const o{.first = 1e-2, .quick = 2, .fair = 5};
  auto const next = [&](linear p) {
    slant::proximal_point method(p, o);
    auto s = method.start(vector(0, 0, 0));
    method.step(s);
    return s.α;
  };
  auto p = singular();
  p.steps = 2;
  CHECK(next(p) == doctest::Approx(1e-3));
  p.steps = 5;
  CHECK(next(p) == doctest::Approx(3e-3));
  p.steps = 6;
  CHECK(next(p) == doctest::Approx(1e-2));
  p.least = 1;  // three failures, 0.05, 0.25, 1.25
  slant::proximal_point method(p, o);
  auto s = method.start(vector(0, 0, 0));
  for (int k = 0; k < 3; ++k) {
    method.step(s);
    CHECK(s.x.norm() == 0);
  }
  CHECK(s.failures == 3);
  CHECK(s.α == doctest::Approx(1.25));
  method.step(s);
  CHECK(s.failures == 3);
  CHECK(s.x.norm() > 0);
}

TEST_CASE("proximal point: an inner solver that never succeeds is a breakdown") {
  auto p = singular();
  p.least = 1e9;
  slant::proximal_point method(p, slant::proximal_point_options<double>{.largest = 1e3});
  auto const r = slant::solve(method, vector(1, 2, 3), slant::at_most(100));
  CHECK(r.status == slant::status::breakdown);
  CHECK(r.iterations() < 20);
  CHECK(r.x() == vector(1, 2, 3));
}

TEST_CASE("proximal point: a step that is better but not exact is made, and α grows") {
  struct halfway {
    slant::proximal_inner_report operator()(vector const& c, double const&, vector& x) const {
      x = c / 2;
      return {.solved = false, .accept = true, .steps = 1};
    }
  };
  slant::proximal_point method(halfway{}, slant::proximal_point_options<double>{.first = 1});
  auto s = method.start(vector(4, 0, 0));
  method.step(s);
  CHECK(s.x == vector(2, 0, 0));
  CHECK(s.step_norm == 2);
  CHECK(s.α == 5);
}

TEST_CASE("proximal point: bad options are named") {
  using options = slant::proximal_point_options<double>;
  auto const make = [](options o) { slant::proximal_point<linear>(singular(), o); };
  CHECK_THROWS_WITH_AS(make({.first = 0}), doctest::Contains("first"), slant::bad_input);
  CHECK_THROWS_WITH_AS(make({.smallest = -1}), doctest::Contains("smallest"), slant::bad_input);
  CHECK_THROWS_WITH_AS(make({.largest = std::nan("")}), doctest::Contains("largest"),
                       slant::bad_input);
  CHECK_THROWS_WITH_AS(make({.first = 1e9}), doctest::Contains("between smallest"),
                       slant::bad_input);
  CHECK_THROWS_WITH_AS(make({.first = 1e-3, .smallest = 1e-2}), doctest::Contains("first"),
                       slant::bad_input);
  CHECK_THROWS_WITH_AS(make({.quick = -1}), doctest::Contains("quick"), slant::bad_input);
  CHECK_THROWS_WITH_AS(make({.quick = 5, .fair = 3}), doctest::Contains("fair"), slant::bad_input);
  CHECK_THROWS_WITH_AS(make({.fast = 0}), doctest::Contains("fast"), slant::bad_input);
  CHECK_THROWS_WITH_AS(make({.slow = 2}), doctest::Contains("slow"), slant::bad_input);
  CHECK_THROWS_WITH_AS(make({.growth = 1}), doctest::Contains("growth"), slant::bad_input);
}

}  // namespace proximal_point_test
