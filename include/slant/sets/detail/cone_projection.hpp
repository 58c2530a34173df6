// SPDX-License-Identifier: MIT
//
// Nearest point of the cone { (n, t) : ‖t‖ <= μ n }.
//
// With ρ = ‖t‖ the point is its own projection for ρ <= μ n, the apex is the projection for
// n + μρ <= 0 (the polar cone), and in between the mantle is met at
//
//     p_n = (n + μρ)/(1 + μ²),   p_t = (μ p_n/ρ) t.
//
// For n < 0 the sum n + μρ cancels, and ρ is no number of the format: double words keep its digits,
// and where even they run out, just outside the polar cone, the sum is (μ²ρ² − n²)/(μρ − n) with a
// numerator that is a polynomial in the data and can be had to any precision.
// Each of n, ρ, μ is split into a number of order one and a power of two, so that neither tiny nor
// huge data nor any μ overflows.
#pragma once

#include <slant/sets/detail/double_word.hpp>
#include <slant/sets/detail/scaled_norm.hpp>
#include <slant/sets/detail/scaling.hpp>

#include <Eigen/Core>

#include <array>
#include <cstddef>

namespace slant::detail {

/// m² Σ tᵢ² − n² to about four times the digits of S relative to n²: all products are split without
/// error, and three sweeps of exact sums move the value to the last place before the rest is added
/// (SumK with K = 4: Ogita, Rump, Oishi, "Accurate sum and dot product", SIAM J. Sci. Comput. 26,
/// 2005).
template <class S, int M>
[[nodiscard]] double_word<S> difference_of_squares(S const& m, Eigen::Matrix<S, M, 1> const& t,
                                                   S const& n) {
  std::array<S, 8 * M + 2> terms;
  std::size_t count = 0;
  auto const put = [&](double_word<S> const& v) {
    terms[count++] = v.lo;
    terms[count++] = v.hi;
  };
  auto const mm = exact_product(m, m);
  for (int i = 0; i < M; ++i) {
    auto const tt = exact_product<S>(t(i), t(i));
    put(exact_product(mm.lo, tt.lo));
    put(exact_product(mm.lo, tt.hi));
    put(exact_product(mm.hi, tt.lo));
    put(exact_product(mm.hi, tt.hi));
  }
  put(exact_product(S(-n), n));
  for (int sweep = 0; sweep < 3; ++sweep) {
    for (std::size_t i = 1; i < count; ++i) {
      auto const sum = exact_sum(terms[i - 1], terms[i]);
      terms[i - 1] = sum.lo;
      terms[i] = sum.hi;
    }
  }
  double_word<S> value;
  for (auto const& term : terms) value = value + double_word<S>(term);
  return value;
}

enum class cone_region : unsigned char { inside, mantle, apex, undefined };

template <class S>
struct cone_foot {
  cone_region region;
  S normal;  ///< p_n
  S factor;  ///< factor · 2^exponent = μ p_n/ρ ∈ [0, 1], the factor of t
  int exponent;
};

/// `x` is (n, t). The region is undefined for an x that holds a NaN or an infinity.
template <class S, int N>
[[nodiscard]] cone_foot<S> nearest_on_cone(S const& μ, Eigen::Matrix<S, N, 1> const& x) {
  using word = double_word<S>;
  if (!x.allFinite()) return {cone_region::undefined, S(0), S(0), 0};
  S const n = x(0);
  Eigen::Matrix<S, N - 1, 1> t = x.template tail<N - 1>();
  if ((t.array() == S(0)).all()) {
    return {n >= S(0) ? cone_region::inside : cone_region::apex, S(0), S(0), 0};
  }
  int const t_unit = binary_exponent(t);
  t = times_power_of_two<S, N - 1>(t, -t_unit);
  auto const ρ = square_root(precise_dot<S>(t, t));
  int const k = binary_exponent(μ);
  S const m = times_power_of_two(μ, -k);

  if (n >= S(0)) {  // ρ <= μ n ?
    int const n_unit = binary_exponent(n) + k;
    int const unit = n_unit > t_unit ? n_unit : t_unit;
    auto const bound = word(m) * word(times_power_of_two(n, k - unit));
    if ((times_power_of_two(ρ, t_unit - unit) - bound).hi <= S(0)) {
      return {cone_region::inside, S(0), S(0), 0};
    }
  }
  int const unit = n == S(0) || binary_exponent(n) < t_unit + k ? t_unit + k : binary_exponent(n);
  S const ns = times_power_of_two(n, -unit);
  auto const μρ = word(m) * times_power_of_two(ρ, t_unit + k - unit);
  auto sum = word(ns) + μρ;
  if (ns < S(0) && sum.hi < -ns / S(1024) && sum.hi > ns / S(1024)) {
    auto const ts = times_power_of_two<S, N - 1>(t, t_unit + k - unit);
    sum = difference_of_squares(m, ts, ns) / (μρ - word(ns));
  }
  if (sum.hi <= S(0)) return {cone_region::apex, S(0), S(0), 0};
  // 1 + μ², for μ > 1 in units of 2^2k.
  int const s_unit = μ > S(1) ? 2 * k : 0;
  auto const s = word(times_power_of_two(S(1), -s_unit)) +
                 times_power_of_two(exact_product(m, m), 2 * k - s_unit);
  S const factor = (word(m) * sum / (s * ρ)).hi;
  int const e = binary_exponent(factor);
  return {cone_region::mantle, times_power_of_two((sum / s).hi, unit - s_unit),
          times_power_of_two(factor, -e), e + k + unit - s_unit - t_unit};
}

}  // namespace slant::detail
