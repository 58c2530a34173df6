// SPDX-License-Identifier: MIT
// expect: has_project
// max-lines-gcc: 25
// max-lines-clang: 35
//
// A part minus its projection.
#include <slant/sets/cartesian.hpp>
#include <slant/sets/half_line.hpp>

struct upper_half_plane {
  static constexpr int dimension = 2;
#ifdef SLANT_COMPLETE
  Eigen::Vector2d project(auto const& x) const { return {x[0], x[1] < 0 ? 0 : x[1]}; }
#endif
  bool contains(auto const& x) const { return x[1] >= 0; }
};

auto const product = slant::cartesian(slant::half_line<>{}, upper_half_plane{});
