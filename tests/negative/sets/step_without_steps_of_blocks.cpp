// SPDX-License-Identifier: MIT
// expect: has_step_to_boundary
// max-lines-gcc: 25
// max-lines-clang: 30
//
// A block minus step_to_boundary: its products have none either.
#include <slant/sets/power.hpp>

struct upper_half_plane {
  static constexpr int dimension = 2;
  Eigen::Vector2d project(auto const& x) const { return {x[0], x[1] < 0 ? 0 : x[1]}; }
  bool contains(auto const& x) const { return x[1] >= 0; }
#ifdef SLANT_COMPLETE
  double step_to_boundary(auto const& x, auto const& d) const { return -x[1] / d[1]; }
#endif
};

double step(Eigen::VectorXd const& x) {
  return slant::power(upper_half_plane{}, 3).step_to_boundary(x, x);
}
