// SPDX-License-Identifier: MIT
// case USE=product WITHOUT_PROJECT: has_project
// case USE=product WITHOUT_PROJECT, max-lines-gcc: 25
// case USE=product WITHOUT_PROJECT, max-lines-clang: 35
// case USE=power WITHOUT_CONTAINS: power: the shape must be a convex set of fixed dimension.*has_contains
// case USE=power WITHOUT_DIMENSION: power: the shape must be a convex set of fixed dimension.*has_static_dimension
// case USE=power WITHOUT_DIMENSION, max-lines-clang: 25
// case USE=face WITHOUT_STATE: a block of this set has no state.x., so its points have no face
// case USE=face WITHOUT_STATE, max-lines-gcc: 25
// case USE=face WITHOUT_STATE, max-lines-clang: 35
// case USE=derivative WITHOUT_SLANT: all_slant
// case USE=derivative WITHOUT_SLANT, max-lines-gcc: 25
// case USE=step WITHOUT_STEP: has_step_to_boundary
// case USE=step WITHOUT_STEP, max-lines-gcc: 25
// max-lines-gcc: 20
// max-lines-clang: 30
//
// A block minus one thing, and what is made of it: without a dimension a power could not know where
// the next block begins; a product has a slanting operator and steps if its parts have them.
#include <slant/sets/cartesian.hpp>
#include <slant/sets/face.hpp>
#include <slant/sets/half_line.hpp>
#include <slant/sets/power.hpp>

struct upper_half_plane {
#ifndef WITHOUT_DIMENSION
  static constexpr int dimension = 2;
#endif
#ifndef WITHOUT_PROJECT
  Eigen::Vector2d project(auto const& x) const { return {x[0], x[1] < 0 ? 0 : x[1]}; }
#endif
#ifndef WITHOUT_CONTAINS
  bool contains(auto const& x) const { return x[1] >= 0; }
#endif
#ifndef WITHOUT_STATE
  slant::block_state state(auto const& x) const {
    return x[1] > 0 ? slant::block_state::free : slant::block_state::sliding;
  }
#endif
#ifndef WITHOUT_SLANT
  Eigen::Matrix2d slant(auto const& x) const {
    return Eigen::Vector2d(1, x[1] < 0 ? 0 : 1).asDiagonal();
  }
#endif
#ifndef WITHOUT_STEP
  double step_to_boundary(auto const& x, auto const& d) const { return -x[1] / d[1]; }
#endif
};

enum class of { product, power, face, derivative, step };

template <class Block>
void use(Block const& block, Eigen::VectorXd const& x) {
  constexpr of use = of::USE;
  if constexpr (use == of::product)
    static_cast<void>(slant::cartesian(slant::half_line<>{}, block));
  if constexpr (use == of::power) static_cast<void>(slant::power(block, 3));
  if constexpr (use == of::face) static_cast<void>(slant::face_of(slant::power(block, 3), x));
  if constexpr (use == of::derivative)
    static_cast<void>(slant::cartesian(slant::half_line<>{}, block).slant(x.head(3).eval()));
  if constexpr (use == of::step) static_cast<void>(slant::power(block, 3).step_to_boundary(x, x));
}

template void use(upper_half_plane const&, Eigen::VectorXd const&);
