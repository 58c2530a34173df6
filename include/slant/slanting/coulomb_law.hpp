// SPDX-License-Identifier: MIT
//
// Coulomb's law with unilateral contact as an equation, in two forms: that of Alart and Curnier,
// and the cone condition with de Saxcé's change of velocity. Both are given contact by contact.
#pragma once

#include <slant/base/entries.hpp>
#include <slant/base/scaling.hpp>
#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/scalar.hpp>
#include <slant/operators/diagonal.hpp>
#include <slant/sets/ball.hpp>
#include <slant/sets/blocks.hpp>
#include <slant/sets/power.hpp>
#include <slant/sets/slants.hpp>
#include <slant/slanting/affine.hpp>
#include <slant/slanting/arithmetic.hpp>
#include <slant/slanting/slanting_part.hpp>

#include <Eigen/Core>

#include <string>
#include <utility>

namespace slant {

// --- blockwise -----------------------------------------------------------------------------------
//
// Functions that are given block by block, as many laws of contact are: the components of a contact
// depend on those of the same contact only,
//
//     F(y) = (F₁(y₁), …, F_m(y_m)),     F°(y) = diag(F₁°(y₁), …, F_m°(y_m)).
//
// A block is what such a function is made of: fixed `dimension` N, `scalar`, value(y) → N numbers,
// slant(y) → N × N matrix, and with(parameters…), which makes others of its kind. Its slanting
// operator is bounded and tells F from the far end, as slanting_function.hpp says; nothing else is
// known about it.

/// What a function can be given by, block by block.
template <class B>
concept function_block =
    has_static_dimension<B> &&
    requires(B const& b, Eigen::Matrix<typename B::scalar, B::dimension, 1> const& y) {
      { b.value(y) } -> numbers_like<point_t<B>, B::dimension, 1>;
      { b.slant(y) } -> numbers_like<point_t<B>, B::dimension, B::dimension>;
    };

/// F_i of type Block on the entries N i … N i + N − 1. Made by `blockwise`. Only slant(y)
/// allocates.
template <function_block Block>
class blockwise_map
    : public slanting_base,
      private detail::equal_parts<Block, consecutive, detail::listed_blocks<Block>> {
  using base = detail::equal_parts<Block, consecutive, detail::listed_blocks<Block>>;

 public:
  using base::base, base::block_count, base::block, base::update;
  using typename base::block_type, typename base::scalar;
  using slant_type = block_diagonal_slant<scalar, Block::dimension, consecutive, false, law_set{}>;

  [[nodiscard]] index rows() const { return this->size(); }
  [[nodiscard]] index cols() const { return this->size(); }

  template <class Y, class V>
    requires std::same_as<scalar_t<Y>, scalar>
  void value(Y const& y, V& v) const {
    auto const& from = slant::local(y);
    auto& to = slant::local(v);
    this->for_each_factor(
        [&](Block const& b, auto const& p) { p.put(to, b.value(p.value(from))); });
  }
  template <class Y>
    requires std::same_as<scalar_t<Y>, scalar>
  [[nodiscard]] slant_type slant(Y const& y) const {
    slant_type g(block_count());
    slant(y, g);
    return g;
  }
  template <class Y>
    requires std::same_as<scalar_t<Y>, scalar>
  void slant(Y const& y, slant_type& g) const {
    detail::check_rows("y", y, cols(), "cols() of the function");
    for (index i = 0; i < block_count(); ++i) {
      g.assign(i, block(i).slant(this->at(i).value(slant::local(y))));
    }
  }
};

/// One block shape.with(parameters[i]…) per entry of the lists, as for slant::power.
/// @throws bad_input naming parameter and block, "mu[3]: got -1, expected …".
template <function_block Block, class... Params>
  requires(detail::takes_parameters<Block, Params...> && (detail::parameter_list<Params> || ...))
[[nodiscard]] auto blockwise(Block const& shape, Params const&... params) {
  return blockwise_map<Block>(detail::listed_blocks<Block>(shape, params...));
}

// --- alart curnier -------------------------------------------------------------------------------
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
    detail::check_option("mu", mu, mu >= S(0) && detail::is_finite(mu), "a finite number >= 0");
  }

  [[nodiscard]] alart_curnier_block with(S const& mu) const { return alart_curnier_block(mu); }
  [[nodiscard]] S const& mu() const { return mu_; }

  [[nodiscard]] vector_type value(vector_type const& z) const {
    if (detail::has_nan(z)) return vector_type::Constant(detail::not_a_number<S>());
    if (!(z(0) > S(0))) return vector_type::Zero();
    tangent_type const t = disc(z).project(detail::tail_of(z));
    return detail::from_entries<vector_type>([&](int i) { return i == 0 ? z(0) : t(i - 1); });
  }

  /// A°, see the top of this section.
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
  return slant::blockwise(alart_curnier_block<N, detail::list_scalar_t<M>>{}, mu);
}

/// r ↦ r − A(r − ρ (W r + q)), ρ a vector with one factor > 0 for each component, in units of 1/W,
/// the same for the tangential components of a contact. W is referenced if it is an lvalue.
/// @throws bad_input naming W, mu, rho, q or the size that is wrong.
template <int N, operand A, class Q, detail::parameter_list M, class R>
[[nodiscard]] auto alart_curnier(A&& w, Q const& q, M const& mu, R const& rho) {
  auto projection = slant::alart_curnier_projection<N>(mu);
  index const n = projection.rows();
  detail::require_size("W", w, n, n, "the components of all contacts");
  detail::check_size("rho", index(slant::local(rho).size()), n, "the components of all contacts,");
  detail::check_size("q", index(slant::local(q).size()), n, "the components of all contacts,");
  detail::check_finite("q", q);
  for (index i = 0; i < n; ++i) {
    auto const& first = slant::local(rho)[i - i % N + (i % N > 0 ? 1 : 0)];
    auto const& own = slant::local(rho)[i];
    if (!(own > scalar_t<R>(0)) || !detail::is_finite(own)) {
      throw bad_input("rho[" + std::to_string(i) + "]", detail::show(own), "a finite number > 0");
    }
    if (own != first) {
      throw bad_input("rho[" + std::to_string(i) + "]", detail::show(own),
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

// --- de saxcé ------------------------------------------------------------------------------------
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

  /// û°, see the top of this section.
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
    detail::check_option(name, mu, mu >= S(0) && detail::is_finite(mu), "a finite number >= 0");
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
  return slant::blockwise(de_saxce_block<N, detail::list_scalar_t<M>>{}, mu);
}

/// The same for orthotropic friction in space, with coefficients along the two tangents.
/// @throws bad_input "mu2[3]: got -1, expected a finite number >= 0".
template <detail::parameter_list M1, detail::parameter_list M2>
[[nodiscard]] auto de_saxce(M1 const& mu1, M2 const& mu2) {
  return slant::blockwise(de_saxce_block<3, detail::list_scalar_t<M1>>{}, mu1, mu2);
}

}  // namespace slant
