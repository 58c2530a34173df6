// SPDX-License-Identifier: MIT
//
// Entries of factors in a shorter precision.
#pragma once

#include <algorithm>
#include <limits>

namespace slant::detail {

/// The value as a T. What is smaller than any entry that matters becomes zero, because processors
/// are slow with numbers below the smallest normal one; what is too large the largest number.
template <class T, class U>
[[nodiscard]] T rounded_entry(U const& value) {
  U const least = U(std::numeric_limits<T>::min()) / U(std::numeric_limits<T>::epsilon());
  U const most = U(std::numeric_limits<T>::max());
  U const v = std::clamp(value, -most, most);
  return v < least && -v < least ? T(0) : static_cast<T>(v);
}

}  // namespace slant::detail
