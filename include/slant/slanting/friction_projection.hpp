// SPDX-License-Identifier: MIT
//
// The projection of Alart and Curnier: contact by contact, z = (z_n, z_t) with friction coefficient
// μ, first onto the half line of pressures and then onto the disc that the pressure allows,
//
//     P(z) = (p, P_disc(μ p)(z_t)),      p = max(0, z_n).
//
// It is no projection onto a convex set: the disc depends on z. Coulomb's law for u = W r + q is
//
//     r = P(r − ρ u),   ρ > 0,   that is   F(r) = 0   with
//
//     auto F = identity_map(n) - friction_projection<3>(mu) * (identity_map(n) - positive(ρ) *
//              affine(W, q));
//
// the natural residual of Tresca's problem whose slip bounds are those of z. With e = z_t/‖z_t‖
//
//     P° = [ 1{z_n ≥ 0}                       0              ]      ‖z_t‖ <= μ p:  e = 0 and I
//          [ μ 1{z_n ≥ 0} e    (μ p/‖z_t‖)(I − e eᵀ)         ]      in place of the last block
//
// the values from inside at the kinks, as those of half lines and discs. For μ p = 0 the disc is a
// point, and the block 0, except that μ e is kept: a contact on the point of closing slides.
//
// Source: P. Alart, A. Curnier, "A mixed formulation for frictional contact problems prone to
// Newton like solution methods", Comput. Methods Appl. Mech. Engrg. 92 (1991).
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/scalar.hpp>
#include <slant/sets/detail/scaled_norm.hpp>
#include <slant/slanting/blockwise.hpp>

#include <Eigen/Core>

namespace slant {

/// P of one contact with N components, normal first. μ >= 0 is finite.
template <int N, scalar S = double>
  requires(N >= 2)
class friction_projection_block {
 public:
  using scalar = S;
  static constexpr int dimension = N;
  using vector_type = Eigen::Matrix<S, N, 1>;
  using matrix_type = Eigen::Matrix<S, N, N>;

  friction_projection_block() = default;

  /// @throws bad_input if mu is NaN, negative or infinite.
  explicit friction_projection_block(S const& mu) : mu_(mu) {
    if (!(mu >= S(0) && detail::is_finite(mu))) {
      throw bad_input("mu", detail::show(mu), "a finite number >= 0");
    }
  }

  [[nodiscard]] friction_projection_block with(S const& mu) const {
    return friction_projection_block(mu);
  }
  [[nodiscard]] S const& mu() const { return mu_; }

  [[nodiscard]] vector_type value(vector_type const& z) const {
    vector_type p = z;
    if (z(0) < S(0)) p(0) = S(0);
    auto const t = detail::scaled_norm<S, N - 1>(z.template tail<N - 1>());
    S const share = detail::times_power_of_two<S>(mu_ * p(0), -t.exponent);
    if (t.value > share) p.template tail<N - 1>() *= share / t.value;
    return p;
  }

  /// P°, see the top of this file.
  [[nodiscard]] matrix_type slant(vector_type const& z) const {
    matrix_type g = matrix_type::Zero();
    bool const closed = z(0) >= S(0);
    if (closed) g(0, 0) = S(1);
    auto const t = detail::scaled_norm<S, N - 1>(z.template tail<N - 1>());
    S const bound = closed ? S(mu_ * z(0)) : S(0);
    S const share = detail::times_power_of_two<S>(bound, -t.exponent);
    if (t.value <= share) {
      if (bound > S(0)) g.template bottomRightCorner<N - 1, N - 1>().setIdentity();
      return g;
    }
    S const τ = share / t.value;
    Eigen::Matrix<S, N - 1, 1> const e =
        detail::times_power_of_two<S, N - 1>(z.template tail<N - 1>(), -t.exponent) / t.value;
    for (int i = 0; i < N - 1; ++i) {
      if (closed) g(i + 1, 0) = mu_ * e(i);
      for (int j = 0; j < N - 1; ++j) {
        if (j == i) continue;
        g(i + 1, i + 1) += τ * (e(j) * e(j));  // 1 − eᵢ² without cancellation
        g(i + 1, j + 1) -= τ * (e(i) * e(j));
      }
    }
    return g;
  }

 private:
  S mu_{1};
};

/// z ↦ P(z) contact by contact, [n, t₁(, t₂)] with N = 2 or 3 components each, of the friction
/// coefficients mu. @throws bad_input "mu[3]: got -1, expected a finite number >= 0".
template <int N, detail::parameter_list M>
[[nodiscard]] auto friction_projection(M const& mu) {
  using S = std::remove_cvref_t<decltype(detail::parameter_at(mu, 0))>;
  return slant::blockwise(friction_projection_block<N, S>{}, mu);
}

}  // namespace slant
