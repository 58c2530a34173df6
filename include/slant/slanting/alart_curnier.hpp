// SPDX-License-Identifier: MIT
//
// Unilateral contact and Coulomb friction as Alart and Curnier write them, contact by contact:
//
//     r_n − P₊(r_n − ρ_n u_n) = 0,
//     r_t − P_disc(μ P₊(r_n − ρ_n u_n)) (r_t − ρ_t u_t) = 0,        u = W r + q,   ρ_n, ρ_t > 0.
//
// Both are r − A(r − ρ u) with one function of z = r − ρ u, block by block,
//
//     A(z) = (P₊(z_n), P_disc(μ P₊(z_n)) z_t),
//
// a projection in each of its arguments but none as a whole: friction is not associated. Zeros are
// those of de Saxcé's natural map, slopes are not. Its generalised derivative, e = z_t/‖z_t‖:
//
//     0                                      z_n < 0                          open
//     I                                      ‖z_t‖ <= μ z_n                   stick
//     [ 1    0                      ]        ‖z_t‖ > μ z_n >= 0               slip
//     [ μ e  (μ z_n/‖z_t‖)(I − eeᵀ) ]
//
// where z_n = 0 counts as contact and ‖z_t‖ = μ z_n as stick, the value from inside as everywhere
// in the library; so at z = 0 it is I for μ > 0. μ = 0 sticks nowhere: diag(1, 0) for z_n >= 0. A
// NaN anywhere in a contact makes its value and its derivative NaN, those of other contacts not.
//
// Source: P. Alart, A. Curnier, "A mixed formulation for frictional contact problems prone to
// Newton like solution methods", Comput. Methods Appl. Mech. Engrg. 92 (1991).
#pragma once

#include <slant/base/entries.hpp>
#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/scalar.hpp>
#include <slant/operators/diagonal.hpp>
#include <slant/sets/ball.hpp>
#include <slant/slanting/affine.hpp>
#include <slant/slanting/arithmetic.hpp>
#include <slant/slanting/blockwise.hpp>

#include <Eigen/Core>

#include <string>
#include <utility>

namespace slant {

/// A of one contact with N components, normal first. μ >= 0 is finite.
template <int N, scalar S = double>
  requires(N >= 2)
class alart_curnier_block {
 public:
  using scalar = S;
  static constexpr int dimension = N;
  using vector_type = Eigen::Matrix<S, N, 1>;
  using matrix_type = Eigen::Matrix<S, N, N>;

  alart_curnier_block() = default;

  /// @throws bad_input if mu is NaN, negative or infinite.
  explicit alart_curnier_block(S const& mu) : mu_(mu) {
    if (!(mu >= S(0) && detail::is_finite(mu))) {
      throw bad_input("mu", detail::show(mu), "a finite number >= 0");
    }
  }

  [[nodiscard]] alart_curnier_block with(S const& mu) const { return alart_curnier_block(mu); }
  [[nodiscard]] S const& mu() const { return mu_; }

  [[nodiscard]] vector_type value(vector_type const& z) const {
    if (detail::has_nan(z)) return vector_type::Constant(detail::not_a_number<S>());
    if (!(z(0) > S(0))) return vector_type::Zero();
    tangent_type const t = disc(z).project(detail::tail_of(z));
    return detail::from_entries<vector_type>([&](int i) { return i == 0 ? z(0) : t(i - 1); });
  }

  /// A°, see the top of this file.
  [[nodiscard]] matrix_type slant(vector_type const& z) const {
    if (detail::has_nan(z)) return matrix_type::Constant(detail::not_a_number<S>());
    if (z(0) < S(0)) return matrix_type::Zero();
    tangent_type const t = detail::tail_of(z);
    auto const length = detail::scaled_norm<S, N - 1>(t);
    S const bound = detail::times_power_of_two<S>(radius(z), -length.exponent);
    matrix_type g = matrix_type::Zero();
    g(0, 0) = S(1);
    if (length.value <= bound) {
      if (mu_ > S(0)) g.setIdentity();
      return g;
    }
    auto const across = disc(z).slant(t);
    for (int i = 1; i < N; ++i) {
      S const e = detail::times_power_of_two<S>(t(i - 1), -length.exponent) / length.value;
      g(i, 0) = mu_ * e;
      for (int j = 1; j < N; ++j) g(i, j) = across(i - 1, j - 1);
    }
    return g;
  }

 private:
  using tangent_type = Eigen::Matrix<S, N - 1, 1>;

  [[nodiscard]] ball<N - 1, S> disc(vector_type const& z) const {
    return ball<N - 1, S>(radius(z));
  }
  /// μ z_n; 0 without friction, also where z_n has overflowed.
  [[nodiscard]] S radius(vector_type const& z) const { return mu_ > S(0) ? S(mu_ * z(0)) : S(0); }

  S mu_{1};
};

/// z ↦ A(z) contact by contact, [n, t₁(, t₂)] with N = 2 or 3 components each, of the friction
/// coefficients mu. @throws bad_input "mu[3]: got -1, expected a finite number >= 0".
template <int N, detail::parameter_list M>
[[nodiscard]] auto alart_curnier_projection(M const& mu) {
  using S = std::remove_cvref_t<decltype(detail::parameter_at(mu, 0))>;
  return slant::blockwise(alart_curnier_block<N, S>{}, mu);
}

/// r ↦ r − A(r − ρ (W r + q)), ρ a vector with one factor > 0 for each component, in units of 1/W,
/// the same for the tangential components of a contact. W is referenced if it is an lvalue.
/// @throws bad_input naming mu, rho or the size that is wrong.
template <int N, operand A, class Q, detail::parameter_list M, class R>
[[nodiscard]] auto alart_curnier(A&& w, Q const& q, M const& mu, R const& rho) {
  auto projection = slant::alart_curnier_projection<N>(mu);
  index const n = projection.rows();
  detail::check_size("rho", index(slant::local(rho).size()), n, "the components of all contacts,");
  for (index i = 0; i < n; ++i) {
    auto const& first = slant::local(rho)[i - i % N + (i % N > 0 ? 1 : 0)];
    if (slant::local(rho)[i] != first) {
      throw bad_input("rho[" + std::to_string(i) + "]", detail::show(slant::local(rho)[i]),
                      detail::show(first) + " as for the other tangent of its contact");
    }
  }
  auto steps = slant::diagonal<slant::positive_definite>(plain_t<R>(rho));
  auto offset = slant::like(q, n);
  vectors::copy(q, offset);
  auto velocity = slant::affine(std::forward<A>(w), std::move(offset));
  return identity_map(n) -
         std::move(projection) * (identity_map(n) - std::move(steps) * std::move(velocity));
}

}  // namespace slant
