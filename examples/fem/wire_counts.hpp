// SPDX-License-Identifier: MIT
//
// The printed numbers of active constraints of the wire: [T Tables 4.1–4.3] and [K Table 2], where
// they agree. The tables write  active bounds : free bounds / active circles : free circles  for 4m
// = n unknowns; since active + free = m, the active ones suffice.
#pragma once

#include <array>
#include <cstddef>

namespace fem {

/// Printed counts for one bound l and radius g, for n = 32, 64, 128, …, 2048.
struct wire_counts {
  static constexpr int not_printed = -1;

  double l;
  double g;
  std::array<int, 7> bounds;   ///< active ones
  std::array<int, 7> circles;  ///< active ones

  /// Number of unknowns of an entry.
  [[nodiscard]] static constexpr int unknowns(std::size_t entry) { return 32 << entry; }
  /// Number of constraints of each kind.
  [[nodiscard]] static constexpr int m(std::size_t entry) { return unknowns(entry) / 4; }
};

inline constexpr std::array printed_wire_counts{
    wire_counts{0, 1.4, {5, 10, 20, 39, 77, 155, 309}, {2, 2, 4, 4, 4, 6, 11}},
    wire_counts{0, 1, {6, 11, 22, 45, 89, 177, 354}, {4, 5, 5, 8, 12, 22, 39}},
    wire_counts{0, 0.5, {7, 13, 26, 52, 104, 208, 416}, {5, 6, 10, 18, 33, 60, 120}},
    wire_counts{0, 0.3, {7, 14, 29, 57, 114, 228, 456}, {5, 9, 16, 26, 49, 95, 186}},
    wire_counts{0, 0.1, {8, 16, 31, 61, 122, 244, 488}, {8, 13, 22, 40, 77, 149, 296}},
    wire_counts{0, 0.01, {8, 16, 32, 64, 127, 253, 506}, {8, 16, 31, 58, 111, 219, 434}},
    wire_counts{0, 0.001, {8, 16, 32, 64, 128, 256, 511}, {8, 16, 32, 64, 126, 249, 496}},
    wire_counts{-1.5, 2, {0, 0, 0, 0, 0, 0, 0}, {0, 0, 0, 0, 0, 0, 0}},
    wire_counts{-1, 2, {1, 1, 1, 1, 1, 1, 1}, {0, 0, 0, 0, 0, 0, 0}},
    wire_counts{-0.8, 2, {1, 1, 3, 4, 8, 16, 30}, {0, 0, 0, 0, 0, 0, 0}},
    wire_counts{-0.5, 2, {3, 4, 6, 10, 21, 40, 79}, {0, 0, 0, 0, 0, 0, 0}},
    wire_counts{-0.1, 2, {4, 6, 12, 23, 45, 89, 178}, {0, 0, 0, 0, 0, 0, 0}},
    wire_counts{0, 2, {5, 9, 19, 37, 73, 146, 292}, {0, 0, 0, 0, 0, 0, 0}}};

}  // namespace fem
