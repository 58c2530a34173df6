// SPDX-License-Identifier: MIT
//
// Euclidean norm of a short vector that neither overflows nor underflows.
#pragma once

#include <slant/base/entries.hpp>
#include <slant/base/scaling.hpp>

#include <Eigen/Core>

#include <cmath>
#include <limits>

namespace slant::detail {

/// The number value · 2^exponent; exponent is 0 unless the squares would leave the range.
template <class S>
struct scaled_number {
  S value;
  int exponent;
};

/// Σ vᵢ² of N entries, summed in pairs of halves so that the error grows like log N and not like N.
template <int N, class S>
[[nodiscard]] S pairwise_squares(S const* v) {
  if constexpr (N <= 4) {
    return sum_of<N>([&](int i) -> S { return v[i] * v[i]; });
  } else {
    return pairwise_squares<N / 2>(v) + pairwise_squares<N - N / 2>(v + N / 2);
  }
}

/// v · 2^e, entry by entry.
template <class S, int N>
[[nodiscard]] Eigen::Matrix<S, N, 1> times_power_of_two(Eigen::Matrix<S, N, 1> const& v, int e) {
  Eigen::Matrix<S, N, 1> scaled;
  for (int i = 0; i < N; ++i) scaled(i) = times_power_of_two<S>(v(i), e);
  return scaled;
}

/// binary_exponent of the largest entry of a vector without NaN or infinity.
template <class S, int N>
[[nodiscard]] int binary_exponent(Eigen::Matrix<S, N, 1> const& v) {
  using std::abs;
  S largest(0);
  for (int i = 0; i < N; ++i) {
    S const magnitude = abs(v(i));
    if (largest < magnitude) largest = magnitude;
  }
  return binary_exponent(largest);
}

/// ‖v‖. NaN if v holds a NaN, otherwise infinity if v holds one.
///
/// The common case costs one square root: the sum of squares is trusted when it is finite and so
/// large that squares lost to underflow stay below its last digit.
template <class S, int N>
[[nodiscard]] scaled_number<S> scaled_norm(Eigen::Matrix<S, N, 1> const& v) {
  using std::abs;
  using std::sqrt;
  using limits = std::numeric_limits<S>;
  if constexpr (N == 1) return {S(abs(v(0))), 0};
  S const squares = pairwise_squares<N>(v.data());
  if (squares <= (limits::max)() &&
      squares >= (limits::min)() / (limits::epsilon() * limits::epsilon())) {
    return {S(sqrt(squares)), 0};
  }
  bool infinite = false;
  for (int i = 0; i < N; ++i) {
    if (any_nan(v(i))) return {not_a_number<S>(), 0};
    infinite = infinite || !is_finite<S>(v(i));
  }
  if (infinite) return {infinity<S>(), 0};
  int const e = binary_exponent(v);
  S const scaled_squares = pairwise_squares<N>(times_power_of_two(v, -e).data());
  return {S(sqrt(scaled_squares)), e};
}

/// ‖v‖ as a number of the format.
template <class S, int N>
[[nodiscard]] S length_of(Eigen::Matrix<S, N, 1> const& v) {
  auto const length = scaled_norm<S, N>(v);
  return times_power_of_two<S>(length.value, length.exponent);
}

}  // namespace slant::detail
