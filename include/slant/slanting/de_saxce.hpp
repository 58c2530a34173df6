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
// Orthotropic friction has the elliptic cone {(r₁/μ₁)² + (r₂/μ₂)² <= r_n²} and, for sliding normal
// to the ellipse, û = (u_n + ‖(μ₁u₁, μ₂u₂)‖, u_t): what is added is the dissipation per normal
// force, the support function of the ellipse at −u_t. e = (μ₁²u₁, μ₂²u₂)/‖(μ₁u₁, μ₂u₂)‖ then,
// without μ.
//
// Source: G. de Saxcé, Z.-Q. Feng, "The bipotential method: a constructive approach to design the
// complete contact law with friction", Math. Comput. Modelling 28 (1998).
#pragma once

#include <slant/base/entries.hpp>
#include <slant/base/scaled_norm.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/scalar.hpp>
#include <slant/slanting/blockwise.hpp>

#include <Eigen/Core>

#include <type_traits>

namespace slant {

/// û = (u_n + ‖(μ₁u₁, …)‖, u_t) of one contact with N components, normal first. The coefficients
/// are finite and >= 0.
template <int N, scalar S = double>
  requires(N >= 2)
class de_saxce_block {
 public:
  using scalar = S;
  static constexpr int dimension = N;
  using vector_type = Eigen::Matrix<S, N, 1>;
  using matrix_type = Eigen::Matrix<S, N, N>;
  using tangent_type = Eigen::Matrix<S, N - 1, 1>;

  /// μ = 1.
  de_saxce_block() = default;

  /// The same coefficient in all directions. @throws bad_input if it is NaN, negative or infinite.
  explicit de_saxce_block(S const& mu) : mu_(tangent_type::Constant(checked("mu", mu))) {}
  /// Orthotropic friction. @throws bad_input as above.
  de_saxce_block(S const& mu1, S const& mu2)
    requires(N == 3)
      : mu_(checked("mu1", mu1), checked("mu2", mu2)) {}

  [[nodiscard]] de_saxce_block with(S const& mu) const { return de_saxce_block(mu); }
  [[nodiscard]] de_saxce_block with(S const& mu1, S const& mu2) const
    requires(N == 3)
  {
    return de_saxce_block(mu1, mu2);
  }
  /// The coefficients along the tangents.
  [[nodiscard]] tangent_type const& mu() const { return mu_; }

  [[nodiscard]] vector_type value(vector_type const& u) const {
    vector_type v = u;
    auto const slip = detail::scaled_norm<S, N - 1>(weighted(u));
    v(0) += detail::times_power_of_two<S>(slip.value, slip.exponent);
    return v;
  }

  /// û°, see the top of this file.
  [[nodiscard]] matrix_type slant(vector_type const& u) const {
    matrix_type g = matrix_type::Identity();
    tangent_type const w = weighted(u);
    auto const slip = detail::scaled_norm<S, N - 1>(w);
    if (slip.value == S(0)) return g;
    for (int j = 1; j < N; ++j) {
      g(0, j) = mu_(j - 1) * (detail::times_power_of_two<S>(w(j - 1), -slip.exponent) / slip.value);
    }
    return g;
  }

 private:
  [[nodiscard]] static S const& checked(char const* name, S const& mu) {
    if (!(mu >= S(0) && detail::is_finite(mu))) {
      throw bad_input(name, detail::show(mu), "a finite number >= 0");
    }
    return mu;
  }
  /// (μ₁u₁, …).
  [[nodiscard]] tangent_type weighted(vector_type const& u) const {
    return detail::from_entries<tangent_type>([&](int i) -> S { return mu_(i) * u(i + 1); });
  }

  tangent_type mu_ = tangent_type::Ones();
};

/// u ↦ û contact by contact, [n, t₁(, t₂)] with N = 2 or 3 components each, of the friction
/// coefficients mu. @throws bad_input "mu[3]: got -1, expected a finite number >= 0".
template <int N, detail::parameter_list M>
[[nodiscard]] auto de_saxce(M const& mu) {
  using S = std::remove_cvref_t<decltype(detail::parameter_at(mu, 0))>;
  return slant::blockwise(de_saxce_block<N, S>{}, mu);
}

/// The same for orthotropic friction in space, with coefficients along the two tangents.
/// @throws bad_input "mu2[3]: got -1, expected a finite number >= 0".
template <detail::parameter_list M1, detail::parameter_list M2>
[[nodiscard]] auto de_saxce(M1 const& mu1, M2 const& mu2) {
  using S = std::remove_cvref_t<decltype(detail::parameter_at(mu1, 0))>;
  return slant::blockwise(de_saxce_block<3, S>{}, mu1, mu2);
}

}  // namespace slant
