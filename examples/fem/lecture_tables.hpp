// SPDX-License-Identifier: MIT
//
// Tables 3, 5 and 6 of the lecture [K]: products with A (n_A) for results of a relative accuracy of
// about 1e−6.
#pragma once

#include <array>

namespace fem {

/// Steps of Newton's method and products.
struct printed_work {
  int steps;
  int products;
};

/// [K Table 3], the steel brick: KPRGP and the interior point method PF(r_tol, c_fact).
struct lecture_brick {
  int k;  ///< 3k × k × k cells
  int unknowns;
  int multipliers;  ///< three per contact node
  printed_work pf_03_099;
  printed_work pf_01_09;
  printed_work pf_001_099;
  int kprgp;
};
inline constexpr std::array<lecture_brick, 7> lecture_table_3{
    {{4, 900, 180, {15, 87}, {14, 92}, {14, 119}, 187},
     {6, 2646, 378, {13, 85}, {13, 96}, {12, 105}, 181},
     {8, 5832, 648, {15, 91}, {14, 104}, {15, 130}, 187},
     {10, 10890, 990, {17, 120}, {15, 116}, {17, 166}, 203},
     {12, 18252, 1404, {16, 106}, {15, 116}, {15, 147}, 230},
     {14, 28350, 1890, {17, 121}, {16, 125}, {16, 151}, 254},
     {16, 41616, 2448, {18, 130}, {17, 130}, {17, 175}, 259}}};

/// [K Table 5], two plates: products with step length β/σ_max.
struct lecture_plates {
  int k;  ///< 3k × k cells per body
  int unknowns;
  int multipliers;  ///< two per pair of contact nodes
  int gimssn;       ///< β = 1.9, as the next two
  int as_s;
  int as;
  int gimssn_15;  ///< β = 15
  int as_s_20;    ///< β = 20
  int as_15;      ///< β = 15
};
inline constexpr std::array<lecture_plates, 5> lecture_table_5{
    {{60, 43920, 360, 203, 262, 198, 86, 85, 89},
     {80, 77760, 480, 240, 323, 227, 101, 95, 89},
     {100, 121200, 600, 270, 339, 253, 96, 95, 105},
     {120, 174240, 720, 279, 361, 265, 113, 106, 106},
     {130, 204360, 780, 290, 381, 286, 108, 109, 110}}};

/// [K Table 6], two bricks: Newton steps and products with β = 1.9.
struct lecture_bricks {
  int p;  ///< p × (p−1) × (p−1) cells per body
  int unknowns;
  int contact_nodes;  ///< m here
  printed_work ssn;
  printed_work imssn;
  printed_work gimssn;
};
inline constexpr std::array<lecture_bricks, 6> lecture_table_6{
    {{16, 24576, 256, {9, 1180}, {10, 161}, {41, 322}},
     {21, 55566, 441, {9, 1428}, {9, 143}, {47, 525}},
     {26, 105456, 676, {11, 2506}, {10, 185}, {52, 643}},
     {31, 178746, 961, {10, 2162}, {10, 190}, {57, 716}},
     {36, 279936, 1296, {10, 2298}, {9, 167}, {65, 835}},
     {41, 413536, 1681, {10, 2586}, {10, 216}, {76, 783}}}};

}  // namespace fem
