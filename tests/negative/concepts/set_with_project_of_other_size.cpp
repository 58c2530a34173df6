// SPDX-License-Identifier: MIT
// expect: 'may_have_size<.*'projects_to_points<
// expect-clang: 'projects_to_points<.*'may_have_size<
// max-lines-gcc: 20
// max-lines-clang: 30
//
// A set of points of the plane whose projection returns three components.
#include <slant/concepts/convex_set.hpp>

#include <Eigen/Core>

struct origin {
  static constexpr int dimension = 2;
#ifdef SLANT_COMPLETE
  Eigen::Vector2d project(auto const&) const { return {0, 0}; }
#else
  Eigen::Vector3d project(auto const&) const { return {0, 0, 0}; }
#endif
  bool contains(auto const& x) const { return x[0] == 0 && x[1] == 0; }
};

static_assert(slant::convex_set<origin, Eigen::VectorXd>);
