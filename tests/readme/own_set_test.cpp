// SPDX-License-Identifier: MIT
//
// The set of a client's own that README.md shows; readme.cmake compares the two.
#include <slant/iteration/solve.hpp>
#include <slant/methods/kprgp.hpp>
#include <slant/operators/identity.hpp>
#include <slant/sets/power.hpp>

#include <slant/testing/laws.hpp>

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <algorithm>
#include <limits>

struct half_plane {  // { x ∈ R² : x₀ + x₁ <= offset }
  static constexpr int dimension = 2;
  double offset = 1;
  static constexpr double ε = std::numeric_limits<double>::epsilon();

  Eigen::Vector2d project(auto const& x) const {
    double const excess = std::max(0.0, x.sum() - offset);
    return x - Eigen::Vector2d::Constant(excess / 2);
  }
  // A band of 8 ε around the line: wider than what rounding leaves P(x) off it.
  bool contains(auto const& x) const { return x.sum() - offset <= 8 * ε * x.norm(); }
  slant::block_state state(auto const& x) const {
    return x.sum() - offset < -8 * ε * x.norm() ? slant::block_state::free
                                                : slant::block_state::sliding;
  }
  double step_to_boundary(auto const& x, auto const& d) const {
    return d.sum() > 0 ? std::max(0.0, offset - x.sum()) / d.sum()
                       : std::numeric_limits<double>::infinity();
  }
  half_plane with(double o) const { return {o}; }  // for power(half_plane{}, offsets)
};
static_assert(slant::separable_set<half_plane, Eigen::Vector2d>);

TEST_CASE("my set keeps its word") {
  slant::testing::check_set_laws(half_plane{});
}

TEST_CASE("KPRGP takes it, and a power of it") {
  Eigen::VectorXd const b = Eigen::Vector4d(3, 2, 1, 0);
  Eigen::VectorXd const offsets = Eigen::Vector2d(1, 2);
  auto const run = slant::solve(
      slant::kprgp{slant::separable_qp{slant::identity(4), b, slant::power(half_plane{}, offsets)}},
      Eigen::VectorXd::Zero(4).eval(), slant::reduced_gradient_below(1e-13));
  CHECK(run.converged());
  CHECK(run.x().isApprox(Eigen::Vector4d(1, 0, 1, 0), 1e-12));
}
