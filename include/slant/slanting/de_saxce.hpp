// SPDX-License-Identifier: MIT
//
// De Saxcé's change of velocity: contact by contact, u = (u_n, u_t) with friction coefficient μ,
//
//     û = (u_n + μ‖u_t‖, u_t).
//
// With it Coulomb's law with unilateral contact, which is not associated (sliding is along u_t, not
// normal to the cone), is a complementarity condition of cones:
//
//     r ∈ K_μ = {‖r_t‖ <= μ r_n},    û ∈ K_μ*,    ûᵀr = 0        ⟺        r = P_K(r − ρ û),  ρ > 0.
//
// So the problem u = W r + q is F(r) = 0 with
//
//     auto F = identity_map(n) -
//              projection(K) * (identity_map(n) - positive(ρ) * (de_saxce<3>(mu) * affine(W, q)));
//
// and F° follows from the chain rule.
//
// Kink. û is differentiable for u_t ≠ 0, with e = u_t/‖u_t‖ and
//
//     û° = [ 1  μ eᵀ ]        at u_t = 0: e = 0, the centre of Clarke's generalised derivative, the
//          [ 0  I    ]        same for every direction of the axes.
//
// Source: G. de Saxcé, Z.-Q. Feng, "The bipotential method: a constructive approach to design the
// complete contact law with friction", Math. Comput. Modelling 28 (1998).
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/scalar.hpp>
#include <slant/sets/detail/scaled_norm.hpp>
#include <slant/slanting/blockwise.hpp>

#include <Eigen/Core>

namespace slant {

/// û = (u_n + μ‖u_t‖, u_t) of one contact with N components, normal first. μ >= 0 is finite.
template <int N, scalar S = double>
  requires(N >= 2)
class de_saxce_block {
 public:
  using scalar = S;
  static constexpr int dimension = N;
  using vector_type = Eigen::Matrix<S, N, 1>;
  using matrix_type = Eigen::Matrix<S, N, N>;

  de_saxce_block() = default;

  /// @throws bad_input if mu is NaN, negative or infinite.
  explicit de_saxce_block(S const& mu) : mu_(mu) {
    if (!(mu >= S(0) && detail::is_finite(mu))) {
      throw bad_input("mu", detail::show(mu), "a finite number >= 0");
    }
  }

  [[nodiscard]] de_saxce_block with(S const& mu) const { return de_saxce_block(mu); }
  [[nodiscard]] S const& mu() const { return mu_; }

  [[nodiscard]] vector_type value(vector_type const& u) const {
    vector_type v = u;
    auto const ρ = slip(u);
    v(0) += detail::times_power_of_two<S>(mu_ * ρ.value, ρ.exponent);
    return v;
  }

  /// û°, see the top of this file.
  [[nodiscard]] matrix_type slant(vector_type const& u) const {
    matrix_type g = matrix_type::Identity();
    auto const ρ = slip(u);
    if (ρ.value == S(0)) return g;
    for (int j = 1; j < N; ++j) {
      g(0, j) = mu_ * (detail::times_power_of_two<S>(u(j), -ρ.exponent) / ρ.value);
    }
    return g;
  }

 private:
  /// ‖u_t‖.
  [[nodiscard]] static detail::scaled_number<S> slip(vector_type const& u) {
    return detail::scaled_norm<S, N - 1>(u.template tail<N - 1>());
  }

  S mu_{1};
};

/// u ↦ û contact by contact, [n, t₁(, t₂)] with N = 2 or 3 components each, of the friction
/// coefficients mu. @throws bad_input "mu[3]: got -1, expected a finite number >= 0".
template <int N, detail::parameter_list M>
[[nodiscard]] auto de_saxce(M const& mu) {
  using S = std::remove_cvref_t<decltype(detail::parameter_at(mu, 0))>;
  return slant::blockwise(de_saxce_block<N, S>{}, mu);
}

}  // namespace slant
