// SPDX-License-Identifier: MIT
//
// Root of a secular equation: of a function on [0, ∞) that is positive on the left of its only root
// and negative on the right, for which Newton's method (perhaps for another form of it) from the
// left rises monotonically to the root. Halving on a logarithmic scale first brings the start near,
// so the number of steps is bounded; the last ones are corrections with the residual in double
// words.
#pragma once

#include <slant/sets/detail/double_word.hpp>

#include <cmath>
#include <limits>
#include <type_traits>

namespace slant::detail {

/// A number in working precision, whether it comes as one or as a double word.
template <class S>
[[nodiscard]] S value_of(double_word<S> const& v) {
  return v.hi;
}
template <class S>
[[nodiscard]] S value_of(S const& v) {
  return v;
}

/// A double word as T, itself or its upper part.
template <class T, class S>
[[nodiscard]] T narrow(double_word<S> const& v) {
  if constexpr (std::is_same_v<T, S>) {
    return v.hi;
  } else {
    return v;
  }
}

template <class S>
[[nodiscard]] double_word<S> root(double_word<S> const& v) {
  return square_root(v);
}
template <class S>
[[nodiscard]] S root(S const& v) {
  using std::sqrt;
  return sqrt(v);
}

/// Equation has residual<T>(z), gain(z) = −step per residual, lower(), upper() bounds of the root,
/// threshold() below which z changes little, and scale(z), what an error of z is measured by.
template <class S, class Equation>
[[nodiscard]] double_word<S> secular_root(Equation const& equation) {
  using std::abs;
  using std::sqrt;
  S const δ = equation.threshold();
  S lower = equation.lower(), upper = equation.upper();
  while (δ + upper > S(4) * (δ + lower)) {
    S const middle = sqrt(δ + upper) * sqrt(δ + lower) - δ;
    if (!(middle > lower && middle < upper)) break;
    (equation.template residual<S>(middle) > S(0) ? lower : upper) = middle;
  }
  S const enough = sqrt(std::numeric_limits<S>::epsilon()) / S(16);
  S z = lower;
  for (int i = 0; i < 64; ++i) {  // the bound only excludes a hang
    S const step = equation.template residual<S>(z) * equation.gain(z);
    S const next = z + step;
    z = next > S(0) ? next : S(0);
    if (!(S(abs(step)) > enough * equation.scale(z))) break;
  }
  for (int i = 0; i < 8; ++i) {
    S const step =
        equation.template residual<double_word<S>>(double_word<S>(z)).hi * equation.gain(z);
    auto const sum = exact_sum(z, step);
    if (!(sum.hi > S(0))) return double_word<S>(z);
    if (!(S(abs(step)) > enough * equation.scale(sum.hi))) return sum;
    z = sum.hi;
  }
  return double_word<S>(z);
}

}  // namespace slant::detail
