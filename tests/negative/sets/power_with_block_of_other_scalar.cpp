// SPDX-License-Identifier: MIT
// expect: power: the shape must.*'same_scalar<.*'projects_to_points<
// expect-clang: 'projects_to_points<.*'same_scalar<
// max-lines-gcc: 20
// max-lines-clang: 30
//
// A block that computes in float and does not say so: its product would be one of doubles.
#include <slant/sets/power.hpp>

struct origin {
  static constexpr int dimension = 2;
#ifdef SLANT_COMPLETE
  using scalar = float;
#endif
  Eigen::Vector2f project(Eigen::Vector2f const& x) const { return 0 * x; }
  bool contains(Eigen::Vector2f const& x) const { return x[0] == 0 && x[1] == 0; }
};

auto const product = slant::power(origin{}, 3);
