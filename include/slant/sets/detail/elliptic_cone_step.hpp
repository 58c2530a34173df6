// SPDX-License-Identifier: MIT
//
// Lengths and longest steps in the elliptic cone.
#pragma once

#include <slant/sets/detail/double_word.hpp>
#include <slant/sets/detail/exit_root.hpp>
#include <slant/sets/detail/scaled_norm.hpp>
#include <slant/sets/detail/scaling.hpp>

#include <Eigen/Core>

namespace slant::detail {

/// ‖(x₁/μ₁, x₂/μ₂)‖, or ‖(μ₁x₁, μ₂x₂)‖, with its exponent apart.
template <class S>
[[nodiscard]] scaled_number<S> elliptic_length(Eigen::Matrix<S, 2, 1> const& μ,
                                               Eigen::Matrix<S, 3, 1> const& x, bool divide) {
  Eigen::Matrix<S, 2, 1> u;
  int exponent[2];
  int largest = 0;
  bool any = false;
  for (int i = 0; i < 2; ++i) {
    int const e = binary_exponent<S>(x(1 + i)), k = binary_exponent<S>(μ(i));
    S const a = times_power_of_two<S>(x(1 + i), -e), m = times_power_of_two<S>(μ(i), -k);
    u(i) = divide ? S(a / m) : S(a * m);
    exponent[i] = divide ? e - k : e + k;
    if (u(i) != S(0) && (!any || exponent[i] > largest)) {
      largest = exponent[i];
      any = true;
    }
  }
  for (int i = 0; i < 2; ++i) u(i) = times_power_of_two<S>(u(i), exponent[i] - largest);
  auto const length = scaled_norm<S, 2>(u);
  return {length.value, length.exponent + largest};
}

/// (n, x₁/μ₁, x₂/μ₂) in double words and in units of 2^exponent, of order one at most.
template <class S>
struct elliptic_coordinates {
  double_word<S> axis, u[2];
  int exponent = 0;

  elliptic_coordinates(Eigen::Matrix<S, 2, 1> const& μ, Eigen::Matrix<S, 3, 1> const& x) {
    int own[3];
    bool any = false;
    for (int i = 0; i < 3; ++i) {
      own[i] = binary_exponent<S>(x(i)) - (i > 0 ? binary_exponent<S>(μ(i - 1)) : 0);
      if (x(i) != S(0) && (!any || own[i] > exponent)) {
        exponent = own[i];
        any = true;
      }
    }
    axis = times_power_of_two<S>(x(0), -exponent);
    for (int i = 0; i < 2; ++i) {
      double_word<S> const m(times_power_of_two<S>(μ(i), -binary_exponent<S>(μ(i))));
      double_word<S> const v(times_power_of_two<S>(x(1 + i), -binary_exponent<S>(x(1 + i))));
      u[i] = times_power_of_two(v / m, own[1 + i] - exponent);
    }
  }
};

/// sup{α >= 0 : x + α d in the cone} for x in the cone and d not in it; see cone_step.hpp.
template <class S>
[[nodiscard]] S elliptic_cone_step(Eigen::Matrix<S, 2, 1> const& μ, Eigen::Matrix<S, 3, 1> const& x,
                                   Eigen::Matrix<S, 3, 1> const& d) {
  S const to_apex = d(0) < S(0) ? S(-(x(0) < S(0) ? S(0) : x(0)) / d(0)) : infinity<S>();
  elliptic_coordinates<S> const u(μ, x), v(μ, d);
  auto const form = [](elliptic_coordinates<S> const& a, elliptic_coordinates<S> const& b) {
    return a.u[0] * b.u[0] + a.u[1] * b.u[1] - a.axis * b.axis;
  };
  S const to_quadric = times_power_of_two<S>(exit_root<S>(form(v, v), form(u, v), -form(u, u)),
                                             u.exponent - v.exponent);
  return to_apex < to_quadric ? to_apex : to_quadric;
}

}  // namespace slant::detail
