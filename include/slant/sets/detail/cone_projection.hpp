// SPDX-License-Identifier: MIT
//
// Nearest point of the cone { (n, t) : ‖t‖ <= μ n } and of its dual { (n, t) : μ‖t‖ <= n }.
//
// Both are { ν‖t‖ <= κ n }, (κ, ν) = (μ, 1) or (1, μ). With ρ = ‖t‖ the point is its own projection
// for νρ <= κ n, the apex is the projection for νn + κρ <= 0 (the polar cone), and in between the
// mantle is met at
//
//     p_n = ν (νn + κρ)/(1 + μ²),   p_t = (κ/ρ) (νn + κρ)/(1 + μ²) t.
//
// For n < 0 the sum νn + κρ cancels, and ρ is no number of the format: double words keep its
// digits, and where even they run out, just outside the polar cone, the sum is
// (κ²ρ² − ν²n²)/(κρ − νn) with a numerator that is a polynomial in the data and can be had to any
// precision. Each of n, ρ, μ is split into a number of order one and a power of two, so that
// neither tiny nor huge data nor any μ overflows.
#pragma once

#include <slant/sets/detail/double_word.hpp>
#include <slant/sets/detail/entries.hpp>
#include <slant/sets/detail/exact_squares.hpp>
#include <slant/sets/detail/scaled_norm.hpp>
#include <slant/sets/detail/scaling.hpp>

#include <Eigen/Core>

#include <limits>

namespace slant::detail {

enum class cone_region : unsigned char { inside, mantle, apex, undefined };

template <class S>
struct cone_foot {
  cone_region region;
  S normal;  ///< p_n
  S factor;  ///< factor · 2^exponent = p_t/t ∈ [0, 1]
  int exponent;

  /// Makes the point x its nearest one.
  template <int N>
  void move(Eigen::Matrix<S, N, 1>& x) const {
    if (region == cone_region::inside) return;
    S const product = times_power_of_two<S>(factor, exponent);
    bool const underflow = product < (std::numeric_limits<S>::min)();
    for (int i = 0; i < N; ++i) {
      S& entry = x.data()[i];
      if (region == cone_region::apex) entry = S(0);
      if (region == cone_region::undefined) entry = not_a_number<S>();
      if (region != cone_region::mantle) continue;
      entry = i == 0      ? normal
              : underflow ? times_power_of_two<S>(factor * entry, exponent)
                          : S(entry * product);
    }
  }
};

/// mantissa · 2^exponent; 0 has the smallest exponent of all.
template <class S>
struct split_number {
  S mantissa;
  int exponent;

  explicit split_number(S const& v)
      : mantissa(times_power_of_two<S>(v, -binary_exponent(v))),
        exponent(v == S(0) ? std::numeric_limits<int>::min() / 8 : binary_exponent(v)) {}
};

/// Nearest point of { ν‖t‖ <= κ n }, (κ, ν) = (μ, 1) or (1, μ), to x = (n, t). The region is
/// undefined for an x that holds a NaN or an infinity.
template <class S, int N>
[[nodiscard]] cone_foot<S> nearest_on_mantle(S const& κ, S const& ν,
                                             Eigen::Matrix<S, N, 1> const& x) {
  using word = double_word<S>;
  if (!all_finite(x)) return {cone_region::undefined, S(0), S(0), 0};
  S const n = x(0);
  Eigen::Matrix<S, N - 1, 1> t = tail_of(x);
  if (all_zero(t)) {
    return {n >= S(0) ? cone_region::inside : cone_region::apex, S(0), S(0), 0};
  }
  int const t_unit = binary_exponent(t);
  t = times_power_of_two<S, N - 1>(t, -t_unit);
  auto const ρ = square_root(precise_dot<S>(t, t));
  split_number<S> const k(κ), l(ν), ns(n);
  auto const larger = [](int a, int b) { return a < b ? b : a; };

  if (n >= S(0)) {  // νρ <= κ n ?
    int const unit = larger(k.exponent + ns.exponent, l.exponent + t_unit);
    auto const bound = exact_product(k.mantissa, ns.mantissa);
    auto const radius = word(l.mantissa) * ρ;
    if ((times_power_of_two(radius, l.exponent + t_unit - unit) -
         times_power_of_two(bound, k.exponent + ns.exponent - unit))
            .hi <= S(0)) {
      return {cone_region::inside, S(0), S(0), 0};
    }
  }
  int const n_unit = l.exponent + ns.exponent;  // of νn
  int const unit = larger(n_unit, k.exponent + t_unit);
  auto const νn = times_power_of_two(exact_product(l.mantissa, ns.mantissa), n_unit - unit);
  auto const κρ = times_power_of_two(word(k.mantissa) * ρ, k.exponent + t_unit - unit);
  auto sum = νn + κρ;
  if (νn.hi < S(0) && sum.hi < -νn.hi / S(1024) && sum.hi > νn.hi / S(1024)) {
    exact_squares<S, N> squares;
    for (int i = 0; i < N - 1; ++i) {
      squares.add(k.mantissa, times_power_of_two<S>(t(i), k.exponent + t_unit - unit));
    }
    squares.subtract(l.mantissa, times_power_of_two<S>(ns.mantissa, n_unit - unit));
    sum = squares.sum() / (κρ - νn);
  }
  if (sum.hi <= S(0)) return {cone_region::apex, S(0), S(0), 0};
  // 1 + μ² = κ² + ν², for μ > 1 in units of 2^2k.
  int const s_unit = 2 * larger(0, larger(k.exponent, l.exponent));
  auto const s =
      times_power_of_two(exact_product(k.mantissa, k.mantissa), 2 * k.exponent - s_unit) +
      times_power_of_two(exact_product(l.mantissa, l.mantissa), 2 * l.exponent - s_unit);
  S const factor = (word(k.mantissa) * sum / (s * ρ)).hi;
  int const e = binary_exponent(factor);
  return {cone_region::mantle,
          times_power_of_two((word(l.mantissa) * sum / s).hi, l.exponent + unit - s_unit),
          times_power_of_two(factor, -e), e + k.exponent + unit - s_unit - t_unit};
}

/// Nearest point of { ‖t‖ <= μ n }.
template <class S, int N>
[[nodiscard]] cone_foot<S> nearest_on_cone(S const& μ, Eigen::Matrix<S, N, 1> const& x) {
  return nearest_on_mantle<S, N>(μ, S(1), x);
}

/// Nearest point of { μ‖t‖ <= n }.
template <class S, int N>
[[nodiscard]] cone_foot<S> nearest_on_dual_cone(S const& μ, Eigen::Matrix<S, N, 1> const& x) {
  return nearest_on_mantle<S, N>(S(1), μ, x);
}

}  // namespace slant::detail
