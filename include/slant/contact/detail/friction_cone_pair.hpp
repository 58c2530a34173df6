// SPDX-License-Identifier: MIT
//
// One contact of friction_interior_point: x and s of the top of that file, and what the linearised
// equations hold of them.
#pragma once

#include <slant/concepts/scalar.hpp>
#include <slant/contact/detail/lorentz_scaling.hpp>

#include <Eigen/Core>

#include <algorithm>

namespace slant::contact::detail {

/// See the top of this file.
template <int N, class S>
struct friction_cone_pair {
  using cone = lorentz<N, S>;
  using part = typename cone::part;
  using block = typename cone::block;

  /// W: the diagonal block of the contact.
  friction_cone_pair(S const& μ, block const& W) : at(S(1), S(1)) {
    D = part::Constant(std::min(μ, S(1)));
    D[0] = S(1) / std::max(μ, S(1));
    has_tangents = μ > S(0);
    S const mean = (D.asDiagonal() * W * D.asDiagonal()).trace() / S(has_tangents ? N : 1);
    weight = mean > S(0) ? mean : S(1);
  }
  /// All of it at u = W r + q, r = D x.
  void look(part const& u) {
    s = at.s();
    p = D.cwiseProduct(u) - s;
    auto const slip = s.template tail<N - 1>();
    S const speed = slip.norm();
    p[0] += speed;
    E.setIdentity();
    if (speed > S(0)) E.row(0).template tail<N - 1>() -= slip.transpose() / speed;
    part const squares = at.Σ().array().square();
    D1 = (weight / squares.array()).min(S(1));
    D2 = squares.array().min(weight);
  }
  /// The aim of the predictor.
  void aim_at_nothing() { aim = -at.λ(); }
  /// That of the corrector after a predictor of length a.
  void aim_at(S const& γ, S const& a) {
    part second = a * a * cone::product(dx, ds);
    second[0] -= γ;
    aim = -at.λ() - cone::quotient(second, at.λ());
  }
  /// The block of A V D₁ + E V D₂ on the diagonal, α Λ added to A, and one beside.
  [[nodiscard]] block own_block(block const& W, S const& α) const {
    block A = D.asDiagonal() * W * D.asDiagonal();
    A.diagonal().array() += α * weight;
    return A * at.V() * D1.asDiagonal() + E * at.V() * D2.asDiagonal();
  }
  [[nodiscard]] block block_of(friction_cone_pair const& other, block const& W) const {
    block const A = D.asDiagonal() * W * other.D.asDiagonal();
    return A * other.at.V() * other.D1.asDiagonal();
  }
  /// −p + E Tᵀ(λ\c).
  [[nodiscard]] part right_hand_side() const { return E * at.adjoint(aim) - p; }
  /// dx and ds from z; how far it is along them to the boundary. A direction along tangents that
  /// there are none of is rounding.
  S turn(part const& z) {
    dx = at.U() * at.Σ().cwiseProduct(D1).cwiseProduct(z);
    if (!has_tangents) dx.template tail<N - 1>().setZero();
    ds = aim - dx;
    return at.length(dx, ds);
  }

  part D;    ///< its diagonal
  S weight;  ///< Λ
  bool has_tangents;
  lorentz_scaling<N, S> at;
  part s, p;
  part aim;     ///< λ \ c
  part dx, ds;  ///< T dx and T⁻ᵀ ds
  part D1, D2;
  block E;
};

}  // namespace slant::contact::detail
