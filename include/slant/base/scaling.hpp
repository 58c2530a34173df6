// SPDX-License-Identifier: MIT
//
// Powers of two, NaN tests, norms of short vectors and the rounding band shared by all sets.
//
// Scaling by a power of two is exact, so a computation that would overflow or underflow can be
// moved to the middle of the exponent range and back without an additional rounding.
#pragma once

#include <slant/base/entries.hpp>
#include <slant/concepts/scalar.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>

namespace slant::detail {

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

/// Relative width of the band around a boundary within which a point counts as being on it. A
/// computed projection is off the boundary by at most four ulp (see the sets); twice that leaves
/// room for the roundings of the membership test itself.
template <class S>
[[nodiscard]] S rounding_band() {
  return S(8) * std::numeric_limits<S>::epsilon();
}

/// √(a² + b²) for a, b ≥ 0, without the squares.
template <class S>
[[nodiscard]] S root_of_squares(S const& a, S const& b) {
  using std::sqrt;
  S const larger = a > b ? a : b, smaller = a > b ? b : a;
  if (!(larger > S(0)) || !is_finite(larger)) return a + b;
  S const ratio = smaller / larger;
  return larger * S(sqrt(S(S(1) + ratio * ratio)));
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
  constexpr int most = std::numeric_limits<S>::max_exponent - 2;
  return detail::power_of_two<S>(std::clamp(detail::binary_exponent(size), -most, most));
}

}  // namespace slant

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
  return from_entries<Eigen::Matrix<S, N, 1>>(
      [&](int i) { return times_power_of_two<S>(v(i), e); });
}

/// binary_exponent of the largest entry of a vector without NaN or infinity.
template <class S, int N>
[[nodiscard]] int binary_exponent(Eigen::Matrix<S, N, 1> const& v) {
  return binary_exponent(largest_of(v));
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
  if (has_nan(v)) return {not_a_number<S>(), 0};
  if (!all_finite(v)) return {infinity<S>(), 0};
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
