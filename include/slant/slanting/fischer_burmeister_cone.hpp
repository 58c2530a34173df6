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
// For μ = 0 it is (r_n + û_n − √(r_n² + û_n²), r_t). The sign is that of the paper, opposite to
// slant::fischer_burmeister.
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
#include <slant/slanting/detail/blockwise_pair.hpp>
#include <slant/slanting/detail/jordan_fischer_burmeister.hpp>
#include <slant/slanting/fischer_burmeister.hpp>

#include <Eigen/Core>

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

  friction_fischer_burmeister() = default;
  explicit friction_fischer_burmeister(S const& mu) : mu_(mu) {
    if (!(mu >= S(0) && is_finite(mu))) {
      throw bad_input("mu", show(mu), "a finite number >= 0");
    }
  }
  [[nodiscard]] friction_fischer_burmeister with(S const& mu) const {
    return friction_fischer_burmeister(mu);
  }

  [[nodiscard]] vector_type value(vector_type const& r, vector_type const& u) const {
    vector_type φ = r;
    if (mu_ == S(0)) {
      φ(0) = -fischer_burmeister_kernel::value<S>(r(0), u(0));
      return φ;
    }
    if (!r.allFinite() || !u.allFinite()) return vector_type::Constant(not_a_number<S>());
    return in_units(jordan_fischer_burmeister<S, N>(scaled(r, S(1) / mu_), scaled(u, mu_)).value());
  }

  /// {∂Φ/∂r, ∂Φ/∂û}.
  [[nodiscard]] std::pair<matrix_type, matrix_type> slants(vector_type const& r,
                                                           vector_type const& u) const {
    std::pair<matrix_type, matrix_type> g{matrix_type::Identity(), matrix_type::Zero()};
    if (mu_ == S(0)) {
      auto const [at_r, at_u] = fischer_burmeister_kernel::slopes<S>(r(0), u(0));
      g.first(0, 0) = -at_r;
      g.second(0, 0) = -at_u;
      return g;
    }
    if (!r.allFinite() || !u.allFinite()) {
      g.first.setConstant(not_a_number<S>());
      g.second.setConstant(not_a_number<S>());
      return g;
    }
    g = jordan_fischer_burmeister<S, N>(scaled(r, S(1) / mu_), scaled(u, mu_)).slants();
    for (int i = 1; i < N; ++i) {  // D⁻¹ P D and D⁻¹ Q D⁻¹
      g.first.row(i) *= mu_;
      g.first.col(i) /= mu_;
      g.second.row(i) *= mu_;
      g.second.col(i) *= mu_;
    }
    return g;
  }

 private:
  [[nodiscard]] static vector_type scaled(vector_type x, S const& factor) {
    x.template tail<N - 1>() *= factor;
    return x;
  }
  [[nodiscard]] vector_type in_units(vector_type const& φ) const { return scaled(φ, mu_); }

  S mu_{1};
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

}  // namespace slant
