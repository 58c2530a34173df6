// SPDX-License-Identifier: MIT
// expect: power: the shape must be a convex set of fixed dimension.*has_contains
// max-lines-gcc: 20
// max-lines-clang: 30
//
// A block minus the test of membership.
#include <slant/sets/power.hpp>

struct upper_half_plane {
  static constexpr int dimension = 2;
  Eigen::Vector2d project(auto const& x) const { return {x[0], x[1] < 0 ? 0 : x[1]}; }
#ifdef SLANT_COMPLETE
  bool contains(auto const& x) const { return x[1] >= 0; }
#endif
};

auto const product = slant::power(upper_half_plane{}, 3);
