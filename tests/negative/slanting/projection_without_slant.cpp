// SPDX-License-Identifier: MIT
// expect: 'has_slant_member['<]
// max-lines-gcc: 25
// max-lines-clang: 30
//
// A set minus the slanting operator of its projection.
#include <slant/slanting/projection.hpp>

struct upper_half_plane {
  static constexpr int dimension = 2;
  Eigen::Vector2d project(auto const& x) const { return {x[0], x[1] < 0 ? 0 : x[1]}; }
  bool contains(auto const& x) const { return x[1] >= 0; }
#ifdef SLANT_COMPLETE
  Eigen::Matrix2d slant(auto const& x) const {
    return Eigen::Vector2d(1, x[1] < 0 ? 0 : 1).asDiagonal();
  }
#endif
};

auto const p = slant::projection(upper_half_plane{});
