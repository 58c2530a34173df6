// SPDX-License-Identifier: MIT
//
// What blocks share: one-sided bounds, and the point where a ray leaves a quadric.
#pragma once

#include <slant/base/double_word.hpp>
#include <slant/base/scaling.hpp>
#include <slant/concepts/scalar.hpp>

#include <cmath>

namespace slant::detail {

// --- bounds --------------------------------------------------------------------------------------

/// x within a few ulp of the bound. A bound 0 is met exactly or not at all, an infinite one never.
template <class S>
[[nodiscard]] bool at_bound(S const& x, S const& bound) {
  using std::abs;
  return is_finite(bound) && S(abs(x - bound)) <= rounding_band<S>() * S(abs(bound));
}

template <class S>
[[nodiscard]] bool at_least(S const& x, S const& l) {
  return x >= l || at_bound(x, l);
}

template <class S>
[[nodiscard]] bool at_most(S const& x, S const& u) {
  return x <= u || at_bound(x, u);
}

/// sup{α >= 0 : l <= x + α d <= u} for x between the bounds; x beyond a bound counts as being on
/// it.
template <class S>
[[nodiscard]] S step_to_bounds(S const& x, S const& d, S const& l, S const& u) {
  if (any_nan(x, d)) return not_a_number<S>();
  if (d == S(0)) return infinity<S>();
  S const bound = d < S(0) ? l : u;
  if (!is_finite(bound)) return infinity<S>();
  if (d < S(0) ? x <= bound : x >= bound) return S(0);
  S const gap = bound - x;
  // Half of everything when the gap between two finite numbers is too large to be one.
  return is_finite(gap) ? S(gap / d) : S((bound / S(2) - x / S(2)) / (d / S(2)));
}

/// y z with the convention 0 · ∞ = 0 of support functions; NaN for y = NaN, also if z = 0.
template <class S>
[[nodiscard]] S support_product(S const& y, S const& z) {
  if (any_nan(y)) return y;
  return y == S(0) || z == S(0) ? S(0) : S(y * z);
}

// --- exit root -----------------------------------------------------------------------------------

/// Smallest α >= 0 beyond which A α² + 2 B α − C <= 0 fails, infinity if there is none.
///
/// C < 0 means a start outside by rounding. It counts as C = 0, unless the ray leads inwards (B <
/// 0): then the second root is the exit, and it does not depend on C much. Of the two formulas for
/// the root the one without subtraction is taken; the cancellation inside A, B, C is the reason why
/// they arrive as double words.
template <class S>
[[nodiscard]] S exit_root(double_word<S> const& A, double_word<S> const& B, double_word<S> C) {
  if (C.hi < S(0) && !(B.hi < S(0))) C = S(0);
  auto discriminant = B * B + A * C;
  if (discriminant.hi < S(0)) discriminant = S(0);
  auto const root = square_root(discriminant);
  if (B.hi > S(0)) return (C / (B + root)).hi;
  if (A.hi > S(0)) return ((root - B) / A).hi;
  if (any_nan(A.hi, B.hi, C.hi)) return not_a_number<S>();
  return infinity<S>();
}

}  // namespace slant::detail
