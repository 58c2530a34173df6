// SPDX-License-Identifier: MIT
//
// Tables 4.1–4.9 of the thesis [T]: the semismooth Newton method SSNM on the wire and, in 4.9, on
// the steel brick. Counts of active constraints are in wire_counts.hpp.
//
// Four numbers of 4.5 and 4.8 have lost digits or separators in the scanned text; they are given as
// `illegible` here, not guessed.
#pragma once

#include <array>
#include <cstddef>
#include <fem/lecture_tables.hpp>

namespace fem {

inline constexpr int failed = -1;       ///< printed as ×, NaN or "out of memory": no result
inline constexpr int illegible = -2;    ///< printed, but not readable in our copy
inline constexpr int not_printed = -3;  ///< no such entry

/// A number as the tables write it.
inline constexpr printed_work no_result{failed, failed};
inline constexpr printed_work unreadable{illegible, illegible};

/// Sizes of the wire in all tables: n = 32, 64, …, 2048 unknowns.
inline constexpr std::array<int, 7> wire_sizes{32, 64, 128, 256, 512, 1024, 2048};

/// Iterations of SSNM from zero, ρ = 1. The exponents of its tolerances (here, and of the fixed
/// inner one in Table 4.5) are not legible in our copy.
struct ssnm_iterations {
  double l;
  double g;
  std::array<int, 7> iterations;
};

/// [T Table 4.1]: g = 2, no circle is active.
inline constexpr std::array<ssnm_iterations, 6> thesis_table_4_1{
    {{-1.5, 2, {2, 2, 2, 2, 2, 2, 2}},
     {-1, 2, {3, 3, 3, 3, 3, 3, 3}},
     {-0.8, 2, {5, 6, 8, 15, 27, 51, 101}},
     {-0.5, 2, {5, 7, 13, 22, 41, 79, 156}},
     {-0.1, 2, {6, 9, 16, 29, 55, 107, 211}},
     {0, 2, {6, 10, 16, 30, 58, 113, 223}}}};

/// [T Table 4.2]: l = 0, bounds and circles are active.
inline constexpr std::array<ssnm_iterations, 6> thesis_table_4_2{
    {{0, 1.4, {7, 10, 16, 29, 54, 104, 206}},
     {0, 1, {7, 8, 13, 22, 42, 82, 161}},
     {0, 0.5, {8, 9, 9, 58, 27, 51, 99}},
     {0, 0.3, {9, failed, 16, failed, failed, 186, failed}},
     {0, 0.1, {10, failed, 64, failed, failed, failed, failed}},
     {0, 0.01, {14, 62, failed, failed, failed, failed, failed}}}};

/// Iterations of SSNM from a start by `qpc` iterations of QPC to the accuracy 10^−accuracy.
struct ssnm_after_qpc {
  int iterations;
  int qpc;
  int accuracy;
};
struct ssnm_after_qpc_row {
  double g;
  std::array<ssnm_after_qpc, 7> entries;
};

/// [T Table 4.3]: l = 0.
inline constexpr std::array<ssnm_after_qpc_row, 4> thesis_table_4_3{
    {{0.3,
      {{{8, 3, 1}, {5, 6, 1}, {3, 69, 2}, {6, 31, 1}, {15, 114, 1}, {9, 373, 1}, {34, 809, 1}}}},
     {0.1,
      {{{7, 3, 1}, {4, 4, 1}, {7, 9, 1}, {3, 99, 2}, {9, 289, 2}, {14, 379, 1}, {15, 1026, 1}}}},
     {0.01,
      {{{19, 2, 1}, {20, 2, 1}, {4, 5, 1}, {5, 10, 1}, {2, 418, 4}, {6, 730, 2}, {10, 1558, 1}}}},
     {0.001,
      {{{20, 2, 1}, {29, 3, 1}, {20, 4, 1}, {2, 10, 1}, {9, 11, 1}, {11, 774, 5}, {2, 1897, 6}}}}}};

/// [T Table 4.4]: l = 0, g = 1; from zero the iterations are those of Table 4.2.
inline constexpr ssnm_after_qpc_row thesis_table_4_4{
    1, {{{8, 1, 1}, {6, 1, 1}, {11, 1, 1}, {4, 532, 2}, {40, 1, 1}, {80, 1, 1}, {159, 1, 1}}}};

/// [T Table 4.5]: l = 0, g = 0.5, variant A. Fixed: one inner tolerance, cold start, ρ = 1.
/// Adaptive: r_tol = 0.01, c_fact = 0.9, warm start, ρ = 0.5.
struct inner_precision_row {
  printed_work fixed;
  printed_work adaptive;
};
inline constexpr std::array<inner_precision_row, 7> thesis_table_4_5{{{{8, 162}, {10, 94}},
                                                                      {{9, 243}, {10, 128}},
                                                                      {{9, 391}, {10, 170}},
                                                                      {{65, 5253}, {13, 341}},
                                                                      {{29, 2997}, {20, 756}},
                                                                      {{49, 7969}, {23, 1317}},
                                                                      {{84, 21846}, unreadable}}};

/// [T Table 4.6]: l = 0, g = 0.5, variant A with r_tol = 0.8 (the last row: 0.01) for
/// n = 256, 512, 1024.
struct precision_factor_row {
  double r_tol;
  double c_fact;
  std::array<printed_work, 3> entries;
};
inline constexpr std::array<precision_factor_row, 11> thesis_table_4_6{
    {{0.8, 0.9, {{{20, 262}, {18, 188}, {17, 397}}}},
     {0.8, 0.8, {{{22, 146}, {17, 269}, {22, 778}}}},
     {0.8, 0.82, {{{14, 82}, {19, 249}, {18, 350}}}},
     {0.8, 0.7, {{{15, 145}, {30, 476}, {47, 3945}}}},
     {0.8, 0.6, {{{19, 167}, {23, 383}, {53, 7745}}}},
     {0.8, 0.5, {{{17, 135}, {19, 419}, {25, 1723}}}},
     {0.8, 0.4, {{{17, 213}, {17, 259}, {17, 539}}}},
     {0.8, 0.3, {{{14, 296}, {13, 301}, {32, 6278}}}},
     {0.8, 0.2, {{{18, 934}, {19, 1627}, {22, 4654}}}},
     {0.8, 0.1, {{{11, 451}, {15, 1649}, {28, 12926}}}},
     {0.01, 0.9, {{{31, 1077}, no_result, {30, 2044}}}}}};

/// [T Table 4.7]: n = 512, c_fact = 0.9, variant A with ρ = 1, 0.9, 0.5, 0.1.
struct penalty_row {
  double r_tol;
  std::array<printed_work, 4> entries;
};
inline constexpr std::array<double, 4> thesis_table_4_7_penalties{1, 0.9, 0.5, 0.1};
inline constexpr std::array<penalty_row, 12> thesis_table_4_7{
    {{0.9, {{{22, 370}, {21, 371}, {24, 314}, {17, 223}}}},
     {0.8, {{{18, 188}, {16, 414}, {16, 230}, {18, 184}}}},
     {0.7, {{{31, 1391}, {17, 201}, {19, 271}, {16, 192}}}},
     {0.6, {{{16, 198}, {19, 337}, {14, 254}, {15, 169}}}},
     {0.5, {{{22, 372}, {21, 355}, {19, 271}, {19, 211}}}},
     {0.4, {{{9, 49}, {15, 558}, {13, 151}, {15, 281}}}},  // 49/9 is printed with an asterisk
     {0.3, {{{16, 438}, {20, 396}, {14, 248}, {19, 251}}}},
     {0.2, {{{13, 319}, {15, 297}, {18, 248}, {18, 302}}}},
     {0.1, {{{21, 409}, {17, 329}, {15, 301}, {14, 218}}}},
     {0.05, {{{18, 430}, {21, 497}, {19, 313}, {15, 309}}}},
     {0.01, {{no_result, {18, 686}, {20, 756}, {14, 518}}}},
     {0.001, {{{23, 1709}, {24, 1784}, {30, 2218}, {22, 1492}}}}}};

/// [T Table 4.8]: l = 0, g = 0.5, c_fact = 0.9; A with r_tol = 0.01, B with 0.01 and with 0.1.
struct variants_row {
  printed_work a;
  printed_work b_001;
  printed_work b_01;
};
inline constexpr std::array<variants_row, 7> thesis_table_4_8{
    {{{10, 94}, {11, 415}, unreadable},
     {{11, 137}, {12, 910}, {13, 425}},
     {{11, 195}, {10, 1064}, {12, 786}},
     {{31, 1077}, {19, 3457}, {17, 1529}},
     {no_result, unreadable, {25, 2841}},
     {{30, 2044}, unreadable, {42, 8410}},
     {{49, 5421}, no_result, {92, 101668}}}};

/// [T Table 4.9], the steel brick with 3k × k × k cells: variants A (r_tol = 0.2, c_fact = 0.4),
/// B (0.1, 0.99), C (0.1, 0.2).
struct brick_variants_row {
  int k;
  int multipliers;  ///< n, three per contact node
  printed_work a;
  printed_work b;
  printed_work c;
};
inline constexpr std::array<brick_variants_row, 8> thesis_table_4_9{
    {{5, 270, {16, 796}, {14, 182}, {10, 802}},
     {6, 378, {16, 1216}, {26, 1480}, {10, 1308}},
     {7, 504, {16, 1536}, {25, 1729}, {10, 1596}},
     {8, 648, {16, 1888}, {21, 2199}, {10, 2246}},
     {9, 810, {17, 2257}, no_result, {11, 3191}},
     {10, 990, {17, 3061}, no_result, {10, 3508}},
     {11, 1188, {17, 3679}, {18, 2102}, {11, 4615}},
     {12, 1404, no_result, {20, 4184}, no_result}}};

}  // namespace fem
