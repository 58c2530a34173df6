// SPDX-License-Identifier: MIT
//
// Is this a solution? The optimality conditions of contact with Tresca friction, evaluated on
// (u, λ) from the data alone: no projection, operator or solver of the library takes part.
//
//     K u + Bᵀλ = f,    λ_ν ≥ 0,  N u ≤ d,  λ_ν (N u − d) = 0,
//     ‖λ_t‖ ≤ g,  and  T u = 0 or (λ_t = g T u / ‖T u‖)                        [K (16)–(18)]
//
// Each violation is a force, divided by F = max(‖f‖, ‖Bᵀλ‖): numbers without units. (If F is 0, by
// the first of ‖K u‖, κ ‖max(−d, 0)‖, ‖λ‖ that is not.) Lengths are turned into forces by a
// stiffness of the body, ρ = F/‖u‖, but at most κ = max K_ii: what moves less than F/κ hardly
// moves, and a rounding error of u must not pass for a large part of it.
#pragma once

#include <slant/compiled.hpp>
#include <slant/contact/contact_data.hpp>

#include <algorithm>
#include <initializer_list>

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

namespace detail {

/// The first that is positive, else 1: then all that it divides is 0.
template <class S>
[[nodiscard]] S first_positive(std::initializer_list<S> candidates) {
  for (S const& c : candidates) {
    if (c > S(0)) return c;
  }
  return S(1);
}

}  // namespace detail

/// Evaluates the conditions. K is n_u × n_u, dense or sparse, u has n_u and λ = (λ_ν, λ_t) has
/// m + rows(T) entries. A NaN in u or λ shows in the residual. Throws bad_input if sizes do not
/// fit, if the data are not valid (see contact::data::validate) or if no K_ii is positive.
template <class S, class Matrix, class V>
[[nodiscard]] optimality<S> check_optimality(Matrix const& K, data<S> const& c, V const& u,
                                             V const& λ) {
  using vector_type = Eigen::VectorX<S>;
  detail::check_scene(K, c);
  vector_type const diagonal = K.diagonal();
  S const κ = diagonal.size() > 0 ? diagonal.maxCoeff() : S(0);
  slant::detail::check_positive("largest diagonal entry of K", κ);
  slant::detail::check_size("u", u.size(), c.f.size());
  slant::detail::check_size("lambda", λ.size(), c.N.rows() + c.T.rows());
  auto const m = c.nodes();
  vector_type const λn = λ.head(m), λt = λ.tail(c.T.rows());
  vector_type Bλ = c.N.transpose() * λn;
  if (c.T.rows() > 0) Bλ += c.T.transpose() * λt;

  optimality<S> o;
  vector_type const Ku = K * u;
  vector_type const interference = (-c.d).cwiseMax(S(0));
  S const force =
      detail::first_positive<S>({std::max<S>(c.f.stableNorm(), Bλ.stableNorm()), Ku.stableNorm(),
                                 κ * interference.stableNorm(), λ.stableNorm()});
  S const ρ = std::min<S>(κ, force / u.stableNorm());  // u = 0: κ
  vector_type const unbalanced = Ku + Bλ - c.f;
  o.equilibrium = unbalanced.stableNorm() / force;

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

#if SLANT_USES_COMPILED
extern template optimality<double> check_optimality<double>(Eigen::SparseMatrix<double> const&,
                                                            data<double> const&,
                                                            Eigen::VectorXd const&,
                                                            Eigen::VectorXd const&);
#endif

}  // namespace slant::contact
