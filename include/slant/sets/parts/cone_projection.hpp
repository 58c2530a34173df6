// SPDX-License-Identifier: MIT
//
// Nearest point of the cone { (n, t) : ‖t‖ <= μ n }.
//
// With ρ = ‖t‖ the point is its own projection for ρ <= μ n, the apex is the projection for
// n + μρ <= 0 (the polar cone), and in between the mantle is met at
//
//     p_n = (n + μρ)/(1 + μ²),   p_t = (μ/ρ) (n + μρ)/(1 + μ²) t.
//
// For n < 0 the sum n + μρ cancels, and ρ is no number of the format: double words keep its
// digits, and where even they run out, just outside the polar cone, the sum is
// (μ²ρ² − n²)/(μρ − n) with a numerator that is a polynomial in the data and can be had to any
// precision. Each of n, ρ, μ is split into a number of order one and a power of two, so that
// neither tiny nor huge data nor any μ overflows.
#pragma once

#include <slant/base/double_word.hpp>
#include <slant/base/entries.hpp>
#include <slant/base/scaled_norm.hpp>
#include <slant/base/scaling.hpp>
#include <slant/sets/parts/bounds.hpp>

#include <Eigen/Core>

#include <cmath>
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

/// Nearest point of { ‖t‖ <= μ n } to x = (n, t). The region is undefined for an x that holds a NaN
/// or an infinity.
template <class S, int N>
[[nodiscard]] cone_foot<S> nearest_on_cone(S const& μ, Eigen::Matrix<S, N, 1> const& x) {
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
  split_number<S> const m(μ), ns(n);
  auto const larger = [](int a, int b) { return a < b ? b : a; };

  if (n >= S(0)) {  // ρ <= μ n ?
    int const unit = larger(m.exponent + ns.exponent, t_unit);
    auto const bound = exact_product(m.mantissa, ns.mantissa);
    if ((times_power_of_two(ρ, t_unit - unit) -
         times_power_of_two(bound, m.exponent + ns.exponent - unit))
            .hi <= S(0)) {
      return {cone_region::inside, S(0), S(0), 0};
    }
  }
  int const unit = larger(ns.exponent, m.exponent + t_unit);
  S const axis = times_power_of_two<S>(ns.mantissa, ns.exponent - unit);
  auto const μρ = times_power_of_two(word(m.mantissa) * ρ, m.exponent + t_unit - unit);
  auto sum = word(axis) + μρ;
  if (axis < S(0) && sum.hi < -axis / S(1024) && sum.hi > axis / S(1024)) {
    exact_squares<S, N> squares;
    for (int i = 0; i < N - 1; ++i) {
      squares.add(m.mantissa, times_power_of_two<S>(t(i), m.exponent + t_unit - unit));
    }
    squares.subtract(S(1), axis);
    sum = squares.sum() / (μρ - word(axis));
  }
  if (sum.hi <= S(0)) return {cone_region::apex, S(0), S(0), 0};
  // 1 + μ², for μ > 1 in units of 2^2m.
  int const s_unit = 2 * larger(0, m.exponent);
  auto const s =
      times_power_of_two(exact_product(m.mantissa, m.mantissa), 2 * m.exponent - s_unit) +
      times_power_of_two(word(S(1)), -s_unit);
  S const factor = (word(m.mantissa) * sum / (s * ρ)).hi;
  int const e = binary_exponent(factor);
  return {cone_region::mantle, times_power_of_two((sum / s).hi, unit - s_unit),
          times_power_of_two(factor, -e), e + m.exponent + unit - s_unit - t_unit};
}

// --- cone slant ----------------------------------------------------------------------------------
//
// Derivative of the projection onto { ‖t‖ <= μ n } where it lands on the mantle.

/// w wᵀ + θ (0 ⊕ (I − e eᵀ)) with e = x_t/‖x_t‖, w = (1, μe)/√(1 + μ²) the generator through the
/// foot p and θ = ‖p_t‖/‖x_t‖ ∈ [0, 1]: differentiate p = w wᵀx with de = (I − eeᵀ) dx_t/‖x_t‖.
template <class S, int N>
[[nodiscard]] Eigen::Matrix<S, N, N> mantle_slant(S const& μ, cone_foot<S> const& foot,
                                                  Eigen::Matrix<S, N, 1> const& x) {
  using std::sqrt;
  Eigen::Matrix<S, N - 1, 1> e = tail_of(x);
  auto const ρ = scaled_norm<S, N - 1>(e);
  for (int i = 0; i < N - 1; ++i) e(i) = times_power_of_two<S>(e(i), -ρ.exponent) / ρ.value;
  S const θ = times_power_of_two<S>(foot.factor, foot.exponent);
  S const q = μ < S(1) ? μ : S(S(1) / μ);
  S const larger = S(1) / sqrt(S(1) + q * q), smaller = q * larger;
  Eigen::Matrix<S, N, 1> w;
  w(0) = μ < S(1) ? larger : smaller;
  for (int i = 1; i < N; ++i) w(i) = (μ < S(1) ? smaller : larger) * e(i - 1);
  Eigen::Matrix<S, N, N> G;
  for (int j = 0; j < N; ++j) {
    for (int i = 0; i < N; ++i) G(i, j) = w(i) * w(j);
  }
  for (int i = 0; i < N - 1; ++i) {
    for (int j = 0; j < N - 1; ++j) {
      if (j == i) continue;
      G(i + 1, i + 1) += θ * (e(j) * e(j));  // 1 − eᵢ² without cancellation
      G(i + 1, j + 1) -= θ * (e(i) * e(j));
    }
  }
  return G;
}

/// μ‖x_t‖ for x = (x_n, x_t), with its exponent apart: it may be no number of the format.
template <class S, int N>
[[nodiscard]] scaled_number<S> scaled_slip(S const& μ, Eigen::Matrix<S, N, 1> const& x) {
  auto const ρ = scaled_norm<S, N - 1>(tail_of(x));
  int const k = binary_exponent(μ);
  return {S(times_power_of_two(μ, -k) * ρ.value), k + ρ.exponent};
}

// --- cone step -----------------------------------------------------------------------------------
//
// Longest step inside a second-order cone.

/// (μ n, t) in units of 2^exponent, the entries of order one at most; 0 keeps exponent 0.
template <class S, int N>
struct cone_coordinates {
  double_word<S> axis;
  Eigen::Matrix<S, N - 1, 1> t;
  int exponent = 0;

  cone_coordinates(S const& μ, Eigen::Matrix<S, N, 1> const& x) : t(tail_of(x)) {
    int const k = binary_exponent(μ);
    bool const has_axis = x(0) != S(0) && μ != S(0);
    int const n_exponent = binary_exponent<S>(x(0)) + k;
    int const t_exponent = binary_exponent(t);
    exponent = has_axis && (all_zero(t) || n_exponent > t_exponent) ? n_exponent : t_exponent;
    axis = double_word<S>(times_power_of_two(μ, -k)) *
           double_word<S>(times_power_of_two<S>(x(0), k - exponent));
    t = times_power_of_two<S, N - 1>(t, -exponent);
  }
};

/// sup{α >= 0 : x + α d in the cone} for x in the cone { ‖t‖ <= μ n } and d not in it.
///
/// The quadric ‖x_t + α d_t‖² = μ²(x_n + α d_n)² also holds the mirror cone, so the step ends at
/// x_n + α d_n = 0 at the latest. That bound decides when the ray runs down a generator, where all
/// coefficients of the quadratic vanish.
template <class S, int N>
[[nodiscard]] S cone_step(S const& μ, Eigen::Matrix<S, N, 1> const& x,
                          Eigen::Matrix<S, N, 1> const& d) {
  S const to_apex = d(0) < S(0) ? S(-(x(0) < S(0) ? S(0) : x(0)) / d(0)) : infinity<S>();
  cone_coordinates<S, N> const u(μ, x), v(μ, d);
  auto const A = precise_dot<S>(v.t, v.t) - v.axis * v.axis;
  auto const B = precise_dot<S>(u.t, v.t) - u.axis * v.axis;
  auto const C = u.axis * u.axis - precise_dot<S>(u.t, u.t);
  S const to_quadric = times_power_of_two<S>(exit_root<S>(A, B, C), u.exponent - v.exponent);
  return to_apex < to_quadric ? to_apex : to_quadric;
}

}  // namespace slant::detail
