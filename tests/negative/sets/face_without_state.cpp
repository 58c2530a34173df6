// SPDX-License-Identifier: MIT
// expect: a block of this set has no state.x., so its points have no face
// max-lines-gcc: 25
// max-lines-clang: 35
//
// A block minus the state of its points.
#include <slant/sets/face.hpp>
#include <slant/sets/power.hpp>

struct upper_half_plane {
  static constexpr int dimension = 2;
  Eigen::Vector2d project(auto const& x) const { return {x[0], x[1] < 0 ? 0 : x[1]}; }
  bool contains(auto const& x) const { return x[1] >= 0; }
#ifdef SLANT_COMPLETE
  slant::block_state state(auto const& x) const {
    return x[1] > 0 ? slant::block_state::free : slant::block_state::sliding;
  }
#endif
};

auto face(Eigen::VectorXd const& x) {
  return slant::face_of(slant::power(upper_half_plane{}, 3), x);
}
