// SPDX-License-Identifier: MIT
//
// Variant A of [T §3.1, §3.3.1]: the generalised saddle-point system
//
//     [ K   Jᵀ ; −ρD(𝒜)J   D(ℐ) ] (dx, dz) = −(F₁, F₂),      K = A + H,
//
// reduced to its nonsymmetric Schur complement, with K = LDLᵀ factored in each Newton step and
// BiCGSTAB on
//
//     S dz = −F₂ − ρD(𝒜) J K⁻¹F₁,     S = D(ℐ) + ρD(𝒜) J K⁻¹Jᵀ;     dx = −K⁻¹(F₁ + Jᵀdz).
//
// Each product by S is one by K⁻¹, a "Hessian multiplication" of [T]; two more frame them.
// Breakdown if K is singular. It may be indefinite.
#pragma once

#include <slant/concepts/vector_algebra.hpp>
#include <slant/newton/bicgstab_solver.hpp>
#include <slant/newton/detail/schur_reduction.hpp>
#include <slant/operators/diagonal.hpp>
#include <slant/operators/schur_complement.hpp>

#include <utility>

namespace slant {

/// BiCGSTAB on the Schur complement; for F°(y) of a kkt_function whose A is a matrix, sparse or
/// dense. operator_applications are those of K⁻¹. Factorisations allocate.
struct schur_bicgstab {
  bicgstab_solver inner{};

  /// Throws bad_input naming the option, its value and what was expected.
  [[gnu::cold]] void validate() const { inner.validate(); }

  template <class G, class V>
    requires detail::factorable_saddle<G, V>
  [[nodiscard]] auto prepare(G const& g, V const& f) const {
    auto common = detail::make_schur_workspace(g, f);
    auto krylov = inner.prepare(schur(g, common), common.reduced);
    return detail::schur_krylov_workspace<decltype(common), decltype(krylov)>{std::move(common),
                                                                              std::move(krylov)};
  }

  template <class G, class V, class P>
    requires detail::factorable_saddle<G, V>
  direction_report<scalar_t<V>> solve(G const& g, V const& f,
                                      direction_request<scalar_t<V>> const& request, V& dy,
                                      P& prepared) const {
    using S = scalar_t<V>;
    auto& p = prepared.common;
    auto const& J = g.jacobian();
    index const n = J.cols();
    index const m = J.rows();
    auto const f1 = slice(n + m, 0, n).segment(f);
    auto const f2 = slice(n + m, n, m).segment(f);
    if (p.factors.factor(g.hessian().get(), g.curvature()) == detail::factored::failed) {
      return detail::no_factors(request, dy);
    }
    vectors::scale(S(g.rho()), g.active(), p.active);
    slant::local(p.inactive) = S(1) - slant::local(g.active()).array();

    p.factors.solve(f1, p.x, p.w);  // x = K⁻¹F₁
    J.apply(p.x, p.reduced);
    slant::local(p.reduced) = f2 + slant::local(p.active).cwiseProduct(slant::local(p.reduced));
    if (!detail::is_finite(S(norm(p.reduced)))) return detail::no_factors(request, dy);
    auto report = inner.solve(schur(g, p), p.reduced, request, p.multipliers, prepared.krylov);
    slant::local(p.force) = f1;
    J.apply_adjoint_add(S(1), p.multipliers, p.force);
    p.factors.solve(p.force, p.x, p.w);  // x = K⁻¹(F₁ + Jᵀdz)
    report.operator_applications += 2;
    report.factorizations = 1;
    detail::finish_direction(g, f, request, dy, p, report);
    return report;
  }

  /// What is missing, in words.
  template <class G, class V>
  static consteval void refuse() {
    static_assert(detail::factorable_saddle<G, V>,
                  "schur_bicgstab: F°(y) must be that of slant::kkt with an Eigen matrix A");
  }

 private:
  /// S, which refers to g and p.
  template <class G, class P>
  [[nodiscard]] static auto schur(G const& g, P const& p) {
    auto const& J = g.jacobian();
    return schur_complement(detail::factored_inverse(p.factors, J.cols()), J,
                            product(detail::diagonal_view(p.active), J),
                            detail::diagonal_view(p.inactive));
  }
};

}  // namespace slant
