// SPDX-License-Identifier: MIT
//
// Longest step inside an axis-parallel ellipse.
#pragma once

#include <slant/sets/detail/double_word.hpp>
#include <slant/sets/detail/entries.hpp>
#include <slant/sets/detail/exit_root.hpp>
#include <slant/sets/detail/scaled_norm.hpp>
#include <slant/sets/detail/scaling.hpp>

#include <Eigen/Core>

namespace slant::detail {

/// sup{α >= 0 : Σ (xᵢ + α dᵢ)²/aᵢ² <= 1}: the unit disc after division by the axes, in double
/// words. Each quotient is formed from numbers of order one, with its exponent apart.
template <class S>
[[nodiscard]] S ellipse_step(Eigen::Matrix<S, 2, 1> const& axes, Eigen::Matrix<S, 2, 1> const& x,
                             Eigen::Matrix<S, 2, 1> const& d) {
  if (has_nan(x) || has_nan(d)) return not_a_number<S>();
  double_word<S> v[2];
  int exponent[2] = {0, 0};
  int f = 0;
  bool moves = false;
  double_word<S> C(S(1));
  double_word<S> u[2];
  for (int i = 0; i < 2; ++i) {
    if (d(i) != S(0) && axes(i) == S(0)) return S(0);
    if (axes(i) == S(0) || !is_finite<S>(axes(i))) continue;
    int const e = binary_exponent<S>(axes(i));
    double_word<S> const axis(times_power_of_two<S>(axes(i), -e));
    u[i] = double_word<S>(times_power_of_two<S>(x(i), -e)) / axis;
    C = C - u[i] * u[i];
    if (d(i) == S(0)) continue;
    int const k = binary_exponent<S>(d(i));
    v[i] = double_word<S>(times_power_of_two<S>(d(i), -k)) / axis;
    exponent[i] = k - e;
    if (!moves || exponent[i] > f) f = exponent[i];
    moves = true;
  }
  if (!moves) return infinity<S>();
  double_word<S> A, B;
  for (int i = 0; i < 2; ++i) {
    auto const w = times_power_of_two(v[i], exponent[i] - f);
    A = A + w * w;
    B = B + u[i] * w;
  }
  return times_power_of_two<S>(exit_root<S>(A, B, C), -f);
}

}  // namespace slant::detail
