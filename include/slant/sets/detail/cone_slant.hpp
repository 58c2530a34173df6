// SPDX-License-Identifier: MIT
//
// Derivative of the projection onto { ν‖t‖ <= κ n }, (κ, ν) = (μ, 1) or (1, μ), where it lands on
// the mantle.
#pragma once

#include <slant/sets/detail/cone_projection.hpp>
#include <slant/sets/detail/entries.hpp>
#include <slant/sets/detail/scaled_norm.hpp>

#include <Eigen/Core>

#include <cmath>

namespace slant::detail {

/// w wᵀ + θ (0 ⊕ (I − e eᵀ)) with e = x_t/‖x_t‖, w = (ν, κe)/√(κ² + ν²) the generator through the
/// foot p and θ = ‖p_t‖/‖x_t‖ ∈ [0, 1]: differentiate p = w wᵀx with de = (I − eeᵀ) dx_t/‖x_t‖.
template <class S, int N>
[[nodiscard]] Eigen::Matrix<S, N, N> mantle_slant(S const& κ, S const& ν, cone_foot<S> const& foot,
                                                  Eigen::Matrix<S, N, 1> const& x) {
  using std::sqrt;
  Eigen::Matrix<S, N - 1, 1> e = tail_of(x);
  auto const ρ = scaled_norm<S, N - 1>(e);
  for (int i = 0; i < N - 1; ++i) e(i) = times_power_of_two<S>(e(i), -ρ.exponent) / ρ.value;
  S const θ = times_power_of_two<S>(foot.factor, foot.exponent);
  S const q = κ < ν ? S(κ / ν) : S(ν / κ);
  S const larger = S(1) / sqrt(S(1) + q * q), smaller = q * larger;
  Eigen::Matrix<S, N, 1> w;
  w(0) = κ < ν ? larger : smaller;
  for (int i = 1; i < N; ++i) w(i) = (κ < ν ? smaller : larger) * e(i - 1);
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

}  // namespace slant::detail
