// SPDX-License-Identifier: MIT
//
// Is this a solution? The optimality conditions of contact with Tresca friction, evaluated on
// (u, λ) from the data alone: no projection, operator or solver of the library takes part.
//
//     K u + Bᵀλ = f,    λ_ν ≥ 0,  N u ≤ d,  λ_ν (N u − d) = 0,
//     ‖λ_t‖ ≤ g,  and  T u = 0 or (λ_t = g T u / ‖T u‖)                        [K (16)–(18)]
//
// Each violation is a force, divided by max(‖f‖, ‖Bᵀλ‖) (by ‖K u‖ if both are 0): numbers without
// units. Lengths are turned into forces by ρ, the same divided by ‖u‖ (by the largest gap if u = 0):
// a stiffness of the body.
#pragma once

#include <slant/contact/contact_data.hpp>

#include <algorithm>
#include <cmath>

namespace slant::contact {

/// Relative violations; all are 0 at the exact solution.
template <class S>
struct optimality {
  S equilibrium = S(0);  ///< ‖K u + Bᵀλ − f‖
  S normal = S(0);       ///< ‖λ_ν − max(0, λ_ν + ρ (N u − d))‖
  S friction = S(0);     ///< ‖λ_t − P(λ_t + ρ T u)‖
  S penetration = S(0);  ///< ρ max(N u − d, 0), largest node
  S adhesion = S(0);     ///< max(−λ_ν, 0), largest node
  S cone = S(0);         ///< max(‖λ_t‖ − g, 0), largest node

  /// The relative KKT residual: the largest of the three residuals; NaN if one of them is.
  [[nodiscard]] S residual() const {
    S const sum = equilibrium + normal + friction;
    return sum == sum ? std::max({equilibrium, normal, friction}) : sum;
  }
};

/// Largest finite |d|: the length that is left if nothing moves.
template <class S>
[[nodiscard]] S largest_gap(data<S> const& c) {
  S largest(0);
  for (index i = 0; i < c.nodes(); ++i) {
    using std::abs;
    if (slant::detail::is_finite(c.d(i))) largest = std::max<S>(largest, S(abs(c.d(i))));
  }
  return largest;
}

/// Evaluates the conditions. K is n_u × n_u, u has n_u and λ = (λ_ν, λ_t) m + rows(T) entries.
template <class S, class Matrix, class V>
[[nodiscard]] optimality<S> check_optimality(Matrix const& K, data<S> const& c, V const& u,
                                             V const& λ) {
  using vector_type = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  slant::detail::check_size("u", u.size(), c.f.size());
  slant::detail::check_size("lambda", λ.size(), c.N.rows() + c.T.rows());
  auto const m = c.nodes();
  vector_type const λn = λ.head(m), λt = λ.tail(c.T.rows());
  vector_type Bλ = c.N.transpose() * λn;
  if (c.T.rows() > 0) Bλ += c.T.transpose() * λt;

  optimality<S> o;
  vector_type const Ku = K * u;
  S length = u.stableNorm();
  S force = std::max<S>(c.f.stableNorm(), Bλ.stableNorm());
  if (force == S(0)) force = Ku.stableNorm();
  if (force == S(0)) {  // no load, no reaction, no displacement: wrong only where d forbids it
    if ((c.d.array() < S(0)).any()) o.normal = o.penetration = S(1);
    return o;
  }
  vector_type const unbalanced = Ku + Bλ - c.f;
  o.equilibrium = unbalanced.stableNorm() / force;
  if (length == S(0)) length = largest_gap(c);
  S const ρ = length == S(0) ? S(1) : force / length;  // no length at all: ρ meets only zeros

  vector_type const opening = c.N * u - c.d;
  vector_type normal(m);
  for (index i = 0; i < m; ++i) {
    S const pushed = λn(i) + ρ * opening(i);
    normal(i) = λn(i) - (pushed > S(0) ? pushed : S(0));
    o.penetration = std::max<S>(o.penetration, ρ * opening(i) / force);
    o.adhesion = std::max<S>(o.adhesion, -λn(i) / force);
  }
  o.normal = normal.stableNorm() / force;
  if (c.T.rows() == 0) return o;

  auto const k = c.tangents();
  vector_type const slip = c.T * u;
  vector_type friction(slip.size());
  for (index i = 0; i < m; ++i) {
    vector_type const τ = λt.segment(k * i, k);
    vector_type const z = τ + ρ * slip.segment(k * i, k);
    S const size = z.stableNorm();
    friction.segment(k * i, k) =
        size > c.g(i) ? vector_type(τ - (c.g(i) / size) * z) : vector_type(τ - z);
    o.cone = std::max<S>(o.cone, (τ.stableNorm() - c.g(i)) / force);
  }
  o.friction = friction.stableNorm() / force;
  return o;
}

}  // namespace slant::contact
