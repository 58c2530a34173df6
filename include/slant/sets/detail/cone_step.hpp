// SPDX-License-Identifier: MIT
//
// Longest step inside a second-order cone.
#pragma once

#include <slant/sets/detail/double_word.hpp>
#include <slant/sets/detail/entries.hpp>
#include <slant/sets/detail/exit_root.hpp>
#include <slant/sets/detail/scaled_norm.hpp>
#include <slant/sets/detail/scaling.hpp>

#include <Eigen/Core>

namespace slant::detail {

/// (κ n, ν t) in units of 2^exponent, the entries of order one at most; 0 keeps exponent 0. What is
/// stored of ν t lacks the mantissa of ν.
template <class S, int N>
struct cone_coordinates {
  double_word<S> axis;
  Eigen::Matrix<S, N - 1, 1> t;
  int exponent = 0;

  cone_coordinates(S const& κ, S const& ν, Eigen::Matrix<S, N, 1> const& x) : t(tail_of(x)) {
    int const k = binary_exponent(κ), l = binary_exponent(ν);
    bool const has_axis = x(0) != S(0) && κ != S(0);
    bool const has_t = !all_zero(t) && ν != S(0);
    int const n_exponent = binary_exponent<S>(x(0)) + k;
    int const t_exponent = binary_exponent(t) + l;
    exponent = has_axis && (!has_t || n_exponent > t_exponent) ? n_exponent : t_exponent;
    axis = double_word<S>(times_power_of_two(κ, -k)) *
           double_word<S>(times_power_of_two<S>(x(0), k - exponent));
    if (has_t) {
      t = times_power_of_two<S, N - 1>(t, l - exponent);
    } else {
      for (int i = 0; i < N - 1; ++i) t(i) = S(0);
    }
  }
};

/// sup{α >= 0 : x + α d in the cone} for x in the cone { ν‖t‖ <= κ n } and d not in it.
///
/// The quadric ν²‖x_t + α d_t‖² = κ²(x_n + α d_n)² also holds the mirror cone, so the step ends at
/// x_n + α d_n = 0 at the latest. That bound decides when the ray runs down a generator, where all
/// coefficients of the quadratic vanish.
template <class S, int N>
[[nodiscard]] S cone_step(S const& κ, S const& ν, Eigen::Matrix<S, N, 1> const& x,
                          Eigen::Matrix<S, N, 1> const& d) {
  S const to_apex = d(0) < S(0) ? S(-(x(0) < S(0) ? S(0) : x(0)) / d(0)) : infinity<S>();
  cone_coordinates<S, N> const u(κ, ν, x), v(κ, ν, d);
  S const m = times_power_of_two(ν, -binary_exponent(ν));
  auto const mm = exact_product(m, m);
  auto const A = mm * precise_dot<S>(v.t, v.t) - v.axis * v.axis;
  auto const B = mm * precise_dot<S>(u.t, v.t) - u.axis * v.axis;
  auto const C = u.axis * u.axis - mm * precise_dot<S>(u.t, u.t);
  S const to_quadric = times_power_of_two<S>(exit_root<S>(A, B, C), u.exponent - v.exponent);
  return to_apex < to_quadric ? to_apex : to_quadric;
}

}  // namespace slant::detail
