// SPDX-License-Identifier: MIT
//
// The unit in which a method measures its gradient r = A x − b. Products such as rᵀAr grow like the
// third power of the data: with entries of 1e150 they overflow, with 1e-150 they vanish. With r
// kept as a multiple of a power of two next to ‖b‖ they grow like A, and because scaling by a power
// of two is exact, the iterates are the same to the last bit.
#pragma once

#include <slant/concepts/checks.hpp>
#include <slant/concepts/scalar.hpp>

#include <algorithm>
#include <limits>

namespace slant {

/// The power of two next to size, 1 if size is zero or not finite. Its reciprocal is finite too.
template <class S>
[[nodiscard]] S unit_near(S const& size) {
  if (!(size > S(0)) || !detail::is_finite(size)) return S(1);
  using std::frexp;
  using std::ldexp;
  int exponent = 0;
  static_cast<void>(frexp(size, &exponent));
  constexpr int most = std::numeric_limits<S>::max_exponent - 2;
  return ldexp(S(1), std::clamp(exponent, -most, most));
}

}  // namespace slant
