// SPDX-License-Identifier: MIT
//
// Derivative of the projection onto the elliptic cone where it lands on the mantle, at the foot p.
//
// With E = diag(−1, 1/μ₁², 1/μ₂²) the foot satisfies x = p + t E p and pᵀE p = 0. So G is 0 along
// the normal E p, 1 along p, which is orthogonal to it, and for the third direction T
//
//     G = p pᵀ/‖p‖² + θ T Tᵀ,     θ = 1/(1 + t TᵀE T)      (T of length 1, T ⟂ p, E p).
//
// In terms of the unit vector Y = (p₁/μ₁, p₂/μ₂)/p_n and α = 1 + μ₁², β = 1 + μ₂² the direction is
//
//     V = p × E p ~ ((1/β − 1/α) Y₁Y₂, −(μ₁/α) Y₂, (μ₂/β) Y₁),    VᵀE V = (Y₁²/β + Y₂²/α)²,
//
// sums of terms of one sign; the curvature of a round cone is 1/μ².
#pragma once

#include <slant/sets/detail/elliptic_cone_foot.hpp>
#include <slant/sets/detail/scaled_norm.hpp>

#include <Eigen/Core>

namespace slant::detail {

/// G at x, with the foot of |x|.
template <class S>
[[nodiscard]] Eigen::Matrix<S, 3, 3> elliptic_mantle_slant(Eigen::Matrix<S, 2, 1> const& μ,
                                                           elliptic_foot<S> const& foot,
                                                           Eigen::Matrix<S, 3, 1> const& x) {
  using vector = Eigen::Matrix<S, 3, 1>;
  S const Y1 = x(1) < S(0) ? S(-foot.unit(0)) : foot.unit(0);
  S const Y2 = x(2) < S(0) ? S(-foot.unit(1)) : foot.unit(1);
  S const α = S(1) + μ(0) * μ(0), β = S(1) + μ(1) * μ(1);
  auto const normalised = [](vector const& v, S& length) -> vector {
    auto const l = scaled_norm<S, 3>(v);
    length = times_power_of_two<S>(l.value, l.exponent);
    return times_power_of_two<S, 3>(v, -l.exponent) / l.value;
  };
  S length(0);
  vector const w = normalised(vector(S(1), μ(0) * Y1, μ(1) * Y2), length);
  vector const T = normalised(vector((μ(0) - μ(1)) * ((μ(0) + μ(1)) / (α * β)) * (Y1 * Y2),
                                     -(μ(0) / α) * Y2, (μ(1) / β) * Y1),
                              length);
  S const curvature = (Y1 * Y1 / β + Y2 * Y2 / α) / length;
  S const θ = foot.one / (foot.one + foot.t * curvature * curvature);
  Eigen::Matrix<S, 3, 3> G;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) G(i, j) = w(i) * w(j) + θ * (T(i) * T(j));
  }
  return G;
}

}  // namespace slant::detail
