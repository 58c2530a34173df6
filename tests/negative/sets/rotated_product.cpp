// SPDX-License-Identifier: MIT
// expect: set_block
// max-lines-gcc: 25
// max-lines-clang: 30
//
// A rotation mixes components: it needs a block, a product of run-time size has too many of them.
#include <slant/sets/ball.hpp>
#include <slant/sets/power.hpp>
#include <slant/sets/rotated.hpp>

#ifdef SLANT_COMPLETE
slant::ball<2> const set;
#else
auto const set = slant::power(slant::ball<2>{}, 1);
#endif

auto const turned = slant::rotated(set, Eigen::Matrix2d::Identity());
