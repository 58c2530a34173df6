// SPDX-License-Identifier: MIT
//
// One contact of friction_interior_point: x and s of the top of that file, and what the linearised
// equations hold of them.
#pragma once

#include <slant/concepts/scalar.hpp>
#include <slant/contact/detail/lorentz_scaling.hpp>
#include <slant/sets/detail/entries.hpp>

#include <Eigen/Core>

#include <algorithm>

namespace slant::contact::detail {

using slant::detail::combination;
using slant::detail::dot_of;
using slant::detail::from_entries;
using slant::detail::multiple_of;
using slant::detail::product_of;

/// See the top of this file.
template <int N, class S>
struct friction_cone_pair {
  using cone = lorentz<N, S>;
  using part = typename cone::part;
  using block = typename cone::block;

  /// W: the diagonal block of the contact.
  friction_cone_pair(S const& μ, block const& W) : at(S(1), S(1)) {
    S const normal = S(1) / std::max(μ, S(1)), tangential = std::min(μ, S(1));
    D = from_entries<part>([&](int i) { return i == 0 ? normal : tangential; });
    has_tangents = μ > S(0);
    S const trace = slant::detail::sum_of<N>([&](int i) -> S { return D[i] * W(i, i) * D[i]; });
    S const mean = trace / S(has_tangents ? N : 1);
    weight = mean > S(0) ? mean : S(1);
  }
  /// D y.
  [[nodiscard]] part scaled(part const& y) const {
    return from_entries<part>([&](int i) -> S { return D[i] * y[i]; });
  }
  /// All of it at u = W r + q, r = D x.
  void look(part const& u) {
    s = at.s();
    p = combination(S(1), scaled(u), S(-1), s);
    S const speed = cone::tangential_length(s);
    p[0] += speed;
    E = from_entries<block>([&](int i, int j) -> S {
      if (i == j) return S(1);
      return i == 0 && speed > S(0) ? S(-s[j] / speed) : S(0);
    });
    auto const square = [&](int i) -> S { return at.Σ()[i] * at.Σ()[i]; };
    D1 = from_entries<part>([&](int i) -> S { return std::min(S(weight / square(i)), S(1)); });
    D2 = from_entries<part>([&](int i) -> S { return std::min(square(i), weight); });
  }
  /// The aim of the predictor.
  void aim_at_nothing() { aim = multiple_of(S(-1), at.λ()); }
  /// That of the corrector after a predictor of length a.
  void aim_at(S const& γ, S const& a) {
    part second = multiple_of(a * a, cone::product(dx, ds));
    second[0] -= γ;
    aim = combination(S(-1), at.λ(), S(-1), cone::quotient(second, at.λ()));
  }
  /// The block of A V D₁ + E V D₂ on the diagonal, α Λ added to A, and one beside.
  [[nodiscard]] block own_block(block const& W, S const& α) const {
    S const proximal = α * weight;
    block const A = from_entries<block>(
        [&](int i, int j) -> S { return D[i] * W(i, j) * D[j] + (i == j ? proximal : S(0)); });
    block const AV = product_of(A, at.V()), EV = product_of(E, at.V());
    return from_entries<block>(
        [&](int i, int j) -> S { return AV(i, j) * D1[j] + EV(i, j) * D2[j]; });
  }
  [[nodiscard]] block block_of(friction_cone_pair const& other, block const& W) const {
    block const A =
        from_entries<block>([&](int i, int j) -> S { return D[i] * W(i, j) * other.D[j]; });
    block const AV = product_of(A, other.at.V());
    return from_entries<block>([&](int i, int j) -> S { return AV(i, j) * other.D1[j]; });
  }
  /// −p + E Tᵀ(λ\c).
  [[nodiscard]] part right_hand_side() const {
    return combination(S(1), product_of(E, at.adjoint(aim)), S(-1), p);
  }
  /// dx and ds from z; how far it is along them to the boundary. A direction along tangents that
  /// there are none of is rounding.
  S turn(part const& z) {
    dx = product_of(at.U(),
                    from_entries<part>([&](int i) -> S { return at.Σ()[i] * D1[i] * z[i]; }));
    for (int i = 1; i < N && !has_tangents; ++i) dx[i] = S(0);
    ds = combination(S(1), aim, S(-1), dx);
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
