// SPDX-License-Identifier: MIT
//
// Conjugate gradients for Newton systems (I − G (I − ρA)) dy = −F that can be symmetrised
// (slanting/symmetrizable.hpp):
//
//     H s = G (ρA − I) F,     H = G (I − G) + ρ G A G,     dy = G s − F.
//
// The residual of the symmetric system is that of Newton's, exactly: with dy = G s − F
//
//     H s − G (ρA − I) F = G u = F + F° dy,      u = s − (I − ρA) dy,
//
// so the Newton residual is watched at no cost. Since r = G u comes with its u, the preconditioner
// G⁺ is free as well: z = G⁺ r = u up to a part in ker G, which H and G do not see. In effect
//
//     (I − G) + ρ G^½ A G^½   on range(G),   eigenvalues between min(1, ρσ_min) and max(1, ρσ_max),
//
// is solved: discs that slide far outside, where G is small, cost nothing, whereas the eigenvalues
// of H itself are as small as G.
//
// One product by A each iteration, and one for the start: that of the first u = s − dy + ρ A dy.
#pragma once

#include <slant/krylov/conjugate_directions.hpp>
#include <slant/krylov/unit.hpp>
#include <slant/newton/detail/iteration_limit.hpp>
#include <slant/newton/direction.hpp>
#include <slant/slanting/symmetrized.hpp>

#include <utility>

namespace slant {

/// What symmetrized_cg keeps; W is the workspace of H.
template <class V, class W>
struct symmetrized_cg_workspace {
  V s;                                 ///< unknown of the symmetric system
  V r;                                 ///< residual F + F° dy = G u, in multiples of unit
  V u;                                 ///< r before G is applied; the preconditioned residual
  conjugate_directions<V> directions;  ///< p, Hp, pᵀHp
  W h_workspace;                       ///< temporaries of H
};

/// CG on the symmetrised Newton system; for operators F°(y) that are `symmetrizable`.
struct symmetrized_cg {
  index max_iterations = 0;  ///< in one Newton step; 0: 10 n + 100
  bool warm_start = false;   ///< begin with what a shortened step left over

  /// Throws bad_input naming the option, its value and what was expected.
  void validate() const { detail::check_iteration_limit(max_iterations); }

  template <class M, class V>
    requires symmetrizable<M> && linear_operator<M, V>
  [[nodiscard]] auto prepare(M const& m, V const& f) const {
    auto blank = [&] { return like(f, slant::local(f).size()); };
    auto h_workspace = slant::workspace(slant::symmetrized(m), f);
    symmetrized_cg_workspace<V, decltype(h_workspace)> p{
        blank(), blank(), blank(), conjugate_directions<V>(f), std::move(h_workspace)};
    slant::local(p.s).setZero();
    return p;
  }

  template <class M, class V, class W>
    requires symmetrizable<M> && linear_operator<M, V>
  direction_report<scalar_t<V>> solve(M const& m, V const& f,
                                      direction_request<scalar_t<V>> const& request, V& dy,
                                      symmetrized_cg_workspace<V, W>& p) const {
    using S = scalar_t<V>;
    auto const h = slant::symmetrized(m);
    auto& w = p.h_workspace;
    auto& d = p.directions;
    S const unit = unit_near(request.residual_norm);
    S const target = detail::attainable(request.tolerance) * request.residual_norm;
    index const limit = detail::iteration_limit(max_iterations, f);
    direction_report<S> report;

    // dy = G s − F,  u = s + (ρA − I) dy,  r = G u
    slant::local(p.s) *= warm_start ? request.leftover : S(0);
    h.step(f, p.s, dy, w);
    h.right_hand_side(dy, p.r, w);
    ++report.operator_applications;
    slant::local(p.u) = (slant::local(p.s) + slant::local(w.first)) * (S(1) / unit);
    slant::local(p.r) = (slant::local(p.r) + slant::local(dy) + slant::local(f)) * (S(1) / unit);
    d.live = false;

    while (true) {
      report.residual_norm = unit * norm(p.r);
      if (report.residual_norm <= target) {
        report.status = status::converged;
      } else if (!detail::is_finite(report.residual_norm)) {
        report.status = status::breakdown;
      } else if (report.iterations >= limit) {
        report.status = status::iteration_limit;
      }
      if (report.status != status::running) break;
      d.advance(p.u);
      d.image(h, w);
      ++report.operator_applications;
      if (!(d.curvature > S(0))) {
        report.status = status::breakdown;
        break;
      }
      S const α = inner_product(p.r, d.p) / d.curvature;
      slant::local(p.s) -= (unit * α) * slant::local(d.p);
      slant::local(p.u) -= α * slant::local(w.first);  // Hp = G w.first
      slant::local(p.r) -= α * slant::local(d.Ap);
      ++report.iterations;
    }
    h.step(f, p.s, dy, w);
    return report;
  }
};

}  // namespace slant
