// SPDX-License-Identifier: MIT
//
// Large pages for large arrays. A sweep over a factor of a hundred megabytes in pages of 4 kB
// spends a third of its time on looking up where they are.
#pragma once

#include <slant/concepts/scalar.hpp>

#if defined(__linux__)
#include <sys/mman.h>

#include <cstdint>
#endif

namespace slant::detail {

/// Asks the system to use large pages for the array of n numbers at `place`, before it is written
/// to. Where there are none, nothing happens.
template <class T>
void prefer_large_pages([[maybe_unused]] T* place, [[maybe_unused]] index n) {
#if defined(__linux__) && defined(MADV_HUGEPAGE)
  constexpr std::uintptr_t page = std::uintptr_t(1) << 21;
  auto const begin = reinterpret_cast<std::uintptr_t>(place);
  auto const first = (begin + page - 1) / page * page;
  auto const last = (begin + static_cast<std::uintptr_t>(n) * sizeof(T)) / page * page;
  if (last > first) madvise(reinterpret_cast<void*>(first), last - first, MADV_HUGEPAGE);
#endif
}

}  // namespace slant::detail
