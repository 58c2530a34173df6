// SPDX-License-Identifier: MIT
//
// The Fischer–Burmeister function of the friction cone, contact by contact: for r = F(y), û = G(y),
//
//     Φ(r, û) = D⁻¹ φ(D r, D⁻¹ û),   φ(x, y) = x + y − (x² + y²)^½,   D = diag(1, 1/μ, 1/μ),
//
// squares and root in the Jordan algebra of the second-order cone. D maps the friction cone K_μ to
// {‖x_t‖ <= x_n}, D⁻¹ its dual K_μ* to the same, and rᵀû stays, so
//
//     Φ(r, û) = 0     ⟺     r ∈ K_μ,  û ∈ K_μ*,  rᵀû = 0.
//
// Coulomb friction is F(r) = r, û = ρ times the velocities after de Saxcé's change of variables, in
// units of forces:
//
//     auto F = fischer_burmeister_cone<3>(mu, identity_map(n),
//                                         positive(ρ) * (de_saxce<3>(mu) * affine(W, q)));
//
// Orthotropic friction has D = diag(1, 1/μ₁, 1/μ₂). A direction without friction, μ_i = 0, takes no
// part, Φ_i = r_i: for μ = 0 it is (r_n + û_n − √(r_n² + û_n²), r_t). The sign is that of the
// paper, opposite to slant::fischer_burmeister.
//
// Accuracy and kinks (x² + y² on the boundary of the cone): see
// detail/jordan_fischer_burmeister.hpp. As for the scalar function the slope at a kink is the limit
// along (x + τ, y + τ), τ ↓ 0.
//
// Source: M. Fukushima, Z.-Q. Luo, P. Tseng, "Smoothing functions for second-order-cone
// complementarity problems", SIAM J. Optim. 12 (2002); strong semismoothness: D. Sun, J. Sun,
// Math. Program. 103 (2005).
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/scalar.hpp>
#include <slant/sets/detail/entries.hpp>
#include <slant/slanting/detail/blockwise_pair.hpp>
#include <slant/slanting/detail/jordan_fischer_burmeister.hpp>

#include <Eigen/Core>

#include <type_traits>
#include <utility>

namespace slant {

namespace detail {

/// Φ of one contact with N components, normal first.
template <int N, class S>
class friction_fischer_burmeister {
 public:
  using scalar = S;
  static constexpr int dimension = N;
  using vector_type = Eigen::Matrix<S, N, 1>;
  using matrix_type = Eigen::Matrix<S, N, N>;

  friction_fischer_burmeister() : mu_(vector_type::Ones()) {}

  [[nodiscard]] friction_fischer_burmeister with(S const& mu) const {
    friction_fischer_burmeister other;
    other.mu_.template tail<N - 1>().setConstant(checked("mu", mu));
    return other;
  }
  [[nodiscard]] friction_fischer_burmeister with(S const& mu1, S const& mu2) const
    requires(N == 3)
  {
    friction_fischer_burmeister other;
    other.mu_(1) = checked("mu1", mu1);
    other.mu_(2) = checked("mu2", mu2);
    return other;
  }

  [[nodiscard]] vector_type value(vector_type const& r, vector_type const& u) const {
    if (!all_finite(r) || !all_finite(u)) return vector_type::Constant(not_a_number<S>());
    int e = 0;
    vector_type φ = in_algebra(r, u, e).value();
    φ(0) = times_power_of_two<S>(φ(0), e);
    for (int i = 1; i < N; ++i) {
      int const k = binary_exponent<S>(mu_(i));
      S const m = times_power_of_two<S>(mu_(i), -k);
      φ(i) = mu_(i) == S(0) ? r(i) : times_power_of_two<S>(m * φ(i), k + e);
    }
    return φ;
  }

  /// {∂Φ/∂r, ∂Φ/∂û}.
  [[nodiscard]] std::pair<matrix_type, matrix_type> slants(vector_type const& r,
                                                           vector_type const& u) const {
    if (!all_finite(r) || !all_finite(u)) {
      matrix_type const bad = matrix_type::Constant(not_a_number<S>());
      return {bad, bad};
    }
    int e = 0;
    auto g = in_algebra(r, u, e).slants();
    for (int i = 1; i < N; ++i) {  // D⁻¹ P D and D⁻¹ Q D⁻¹
      g.first.row(i) *= mu_(i);
      g.second.row(i) *= mu_(i);
      g.second.col(i) *= mu_(i);
      if (mu_(i) > S(0)) {
        g.first.col(i) /= mu_(i);
      } else {
        g.first.col(i).setZero();
        g.first(i, i) = S(1);
      }
    }
    return g;
  }

 private:
  using jordan = jordan_fischer_burmeister<S, N>;

  [[nodiscard]] static S const& checked(char const* name, S const& mu) {
    if (!(mu >= S(0) && is_finite(mu))) {
      throw bad_input(name, show(mu), "a finite number >= 0");
    }
    return mu;
  }
  /// φ at x = D r, y = D⁻¹ û in units of 2^e, in which they are numbers for every μ; a direction
  /// without friction takes no part.
  [[nodiscard]] jordan in_algebra(vector_type const& r, vector_type const& u, int& e) const {
    int k[N], l[N];  // exponents of the components of x and y
    bool any = false;
    auto const include = [&](S const& v, int exponent) {
      if (v != S(0) && (!any || exponent > e)) {
        e = exponent;
        any = true;
      }
    };
    for (int i = 0; i < N; ++i) {
      int const of_mu = i == 0 ? 0 : binary_exponent<S>(mu_(i));
      k[i] = binary_exponent<S>(r(i)) - of_mu;
      l[i] = binary_exponent<S>(u(i)) + of_mu;
      if (mu_(i) == S(0)) continue;
      include(r(i), k[i]);
      include(u(i), l[i]);
    }
    vector_type x, y;
    for (int i = 0; i < N; ++i) {
      S const m = i == 0 ? S(1) : times_power_of_two<S>(mu_(i), -binary_exponent<S>(mu_(i)));
      S const a = times_power_of_two<S>(r(i), -binary_exponent<S>(r(i)));
      S const b = times_power_of_two<S>(u(i), -binary_exponent<S>(u(i)));
      x(i) = m > S(0) ? times_power_of_two<S>(a / m, k[i] - e) : S(0);
      y(i) = times_power_of_two<S>(b * m, l[i] - e);
    }
    return jordan(x, y);
  }

  vector_type mu_;  // (1, μ₁, …)
};

}  // namespace detail

/// Φ(F, G) of the contacts with the coefficients mu, N components each. F and G are
/// `Function const&` (referenced) or function types (owned).
template <int N, class S, class F, class G>
using fischer_burmeister_cone_map =
    detail::blockwise_pair<detail::friction_fischer_burmeister<N, S>, F, G>;

/// y ↦ Φ(F(y), G(y)) contact by contact, [n, t₁(, t₂)] with N = 2 or 3 components each. Lvalues are
/// referenced. @throws bad_input "mu[3]: got -1, expected a finite number >= 0", or if sizes
/// differ.
template <int N, detail::parameter_list M, slanting_part F, slanting_part G>
[[nodiscard]] auto fischer_burmeister_cone(M const& mu, F&& f, G&& g) {
  using S = std::remove_cvref_t<decltype(detail::parameter_at(mu, 0))>;
  using kernel = detail::friction_fischer_burmeister<N, S>;
  return fischer_burmeister_cone_map<N, S, kept_t<F>, kept_t<G>>(
      detail::listed_blocks<kernel>(kernel{}, mu), std::forward<F>(f), std::forward<G>(g));
}

/// The same for orthotropic friction in space, with coefficients along the two tangents.
template <detail::parameter_list M1, detail::parameter_list M2, slanting_part F, slanting_part G>
[[nodiscard]] auto fischer_burmeister_cone(M1 const& mu1, M2 const& mu2, F&& f, G&& g) {
  using S = std::remove_cvref_t<decltype(detail::parameter_at(mu1, 0))>;
  using kernel = detail::friction_fischer_burmeister<3, S>;
  return fischer_burmeister_cone_map<3, S, kept_t<F>, kept_t<G>>(
      detail::listed_blocks<kernel>(kernel{}, mu1, mu2), std::forward<F>(f), std::forward<G>(g));
}

}  // namespace slant
