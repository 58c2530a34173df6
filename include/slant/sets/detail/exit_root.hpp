// SPDX-License-Identifier: MIT
//
// Where a ray that starts inside a quadric leaves it.
#pragma once

#include <slant/sets/detail/double_word.hpp>
#include <slant/sets/detail/scaling.hpp>

namespace slant::detail {

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
