// SPDX-License-Identifier: MIT
// expect: 'has_contains['<]
// max-lines-gcc: 25
// max-lines-clang: 30
//
// A set minus the test of membership.
#include <slant/concepts/convex_set.hpp>

#include <Eigen/Core>

struct origin {
  static constexpr int dimension = 2;
  Eigen::Vector2d project(auto const&) const { return {0, 0}; }
#ifdef SLANT_COMPLETE
  bool contains(auto const& x) const { return x[0] == 0 && x[1] == 0; }
#endif
};

static_assert(slant::convex_set<origin, Eigen::Vector2d>);
