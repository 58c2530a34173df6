// SPDX-License-Identifier: MIT
//
// Table 4 of the lecture [K]: products with A of its active-set and path-following methods for the
// channel with an obstacle.
#pragma once

#include <array>

namespace fem {

/// One row; products for g = 10 and g = 30.
struct lecture_stokes {
  int refinement;
  int velocities, pressures, wall_nodes;
  std::array<int, 2> active_set;  ///< AS; 0: printed as > 200000
  std::array<int, 2> path_following;
};

inline constexpr std::array<double, 2> lecture_slip_bounds{10, 30};

inline constexpr std::array<lecture_stokes, 4> lecture_table_4{{
    {1, 862, 526, 30, {6867, 682}, {208, 181}},
    {2, 3566, 1972, 60, {22579, 1060}, {283, 268}},
    {3, 14494, 7624, 120, {130615, 1816}, {374, 389}},
    {4, 58430, 29968, 240, {0, 3083}, {459, 454}},
}};

}  // namespace fem
