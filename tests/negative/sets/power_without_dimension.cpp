// SPDX-License-Identifier: MIT
// expect: power: the shape must be a convex set of fixed dimension.*has_static_dimension
// max-lines-gcc: 20
// max-lines-clang: 25
//
// A block minus its dimension: a power could not know where the next block begins.
#include <slant/sets/power.hpp>

struct upper_half_plane {
#ifdef SLANT_COMPLETE
  static constexpr int dimension = 2;
#endif
  Eigen::Vector2d project(auto const& x) const { return {x[0], x[1] < 0 ? 0 : x[1]}; }
  bool contains(auto const& x) const { return x[1] >= 0; }
};

auto const product = slant::power(upper_half_plane{}, 3);
