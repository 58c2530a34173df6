// SPDX-License-Identifier: MIT
// expect: all_slant
// max-lines-gcc: 25
// max-lines-clang: 30
//
// A part minus its slanting operator: the product of all has none either.
#include <slant/sets/cartesian.hpp>
#include <slant/sets/half_line.hpp>

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

auto derivative(Eigen::Vector3d const& x) {
  return slant::cartesian(slant::half_line<>{}, upper_half_plane{}).slant(x);
}
