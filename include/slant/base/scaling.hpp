// SPDX-License-Identifier: MIT
//
// Powers of two, NaN tests and the rounding band shared by all sets.
//
// Scaling by a power of two is exact, so a computation that would overflow or underflow can be
// moved to the middle of the exponent range and back without an additional rounding.
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/scalar.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace slant::detail {

/// e with 2^(e-1) <= |v| < 2^e for finite v != 0, and 0 for v = 0.
template <class S>
[[nodiscard]] int binary_exponent(S const& v) {
  using std::frexp;
  int e = 0;
  static_cast<void>(frexp(v, &e));
  return e;
}

/// v · 2^e, exact unless the result leaves the range of normal numbers.
template <class S>
[[nodiscard]] S times_power_of_two(S const& v, int e) {
  using std::ldexp;
  return e == 0 ? v : S(ldexp(v, e));
}

template <class... S>
[[nodiscard]] bool any_nan(S const&... v) {
  return (!(v == v) || ...);
}

template <class S>
[[nodiscard]] S not_a_number() {
  return std::numeric_limits<S>::quiet_NaN();
}

template <class S>
[[nodiscard]] S infinity() {
  return std::numeric_limits<S>::infinity();
}

/// Relative width of the band around a boundary within which a point counts as being on it. A
/// computed projection is off the boundary by at most four ulp (see the sets); twice that leaves
/// room for the roundings of the membership test itself.
template <class S>
[[nodiscard]] S rounding_band() {
  return S(8) * std::numeric_limits<S>::epsilon();
}

}  // namespace slant::detail

namespace slant {

// --- unit ----------------------------------------------------------------------------------------
//
// The unit in which a method measures its gradient r = A x − b. Products such as rᵀAr grow like the
// third power of the data: with entries of 1e150 they overflow, with 1e-150 they vanish. With r
// kept as a multiple of a power of two next to ‖b‖ they grow like A, and because scaling by a power
// of two is exact, the iterates are the same to the last bit.

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
