// SPDX-License-Identifier: MIT
// expect: has_slant.*'c.slant.x.' does not satisfy return-type-requirement
// expect-clang: 'slant_like<.*'may_have_size<
// max-lines-gcc: 20
// max-lines-clang: 40
//
// A block of two components whose slanting operator is a matrix of one row.
#include <slant/concepts/convex_set.hpp>

#include <Eigen/Core>

struct origin {
  static constexpr int dimension = 2;
  Eigen::Vector2d project(auto const&) const { return {0, 0}; }
  bool contains(auto const& x) const { return x[0] == 0 && x[1] == 0; }
#ifdef SLANT_COMPLETE
  Eigen::Matrix2d slant(auto const&) const { return Eigen::Matrix2d::Zero(); }
#else
  Eigen::RowVector2d slant(auto const&) const { return {0, 0}; }
#endif
};

static_assert(slant::has_slant<origin, Eigen::Vector2d>);
