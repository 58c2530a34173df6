// SPDX-License-Identifier: MIT
//
// Variant C of [T §3.2]: in the generalised saddle-point system
//
//     [ K   Jᵀ ; −ρD(𝒜)J   D(ℐ) ] (dx, dz) = −(F₁, F₂),      K = A + H,
//
// the inactive multipliers are known, dz_ℐ = −F₂,ℐ. Without them the system is symmetric, and its
// Schur complement is definite where K is and the active gradients are independent: CG on
//
//     J_𝒜 K⁻¹J_𝒜ᵀ dz_𝒜 = −F₂,𝒜/ρ − J_𝒜 K⁻¹(F₁ + J_ℐᵀdz_ℐ);     dx = −K⁻¹(F₁ + Jᵀdz).
//
// Vectors keep the size of z, with zeros in ℐ, so that nothing is made anew when 𝒜 changes. Each
// product is one by K⁻¹; two more frame them. Breakdown if K = LDLᵀ is not positive definite.
#pragma once

#include <slant/concepts/vector_algebra.hpp>
#include <slant/newton/cg_solver.hpp>
#include <slant/newton/detail/schur_reduction.hpp>
#include <slant/operators/congruence.hpp>
#include <slant/operators/declare.hpp>
#include <slant/operators/diagonal.hpp>
#include <slant/operators/product.hpp>
#include <slant/operators/sum.hpp>

#include <utility>

namespace slant {

/// CG on the symmetrised Schur complement; for F°(y) of a kkt_function whose A is a matrix, sparse
/// or dense. operator_applications are those of K⁻¹. Factorisations allocate.
struct schur_cg {
  cg_solver inner{};

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
    if (p.factors.factor(g.hessian().get(), g.curvature()) != detail::factored::definite) {
      return detail::no_factors(request, dy);
    }
    vectors::copy(g.active(), p.active);
    slant::local(p.inactive) = S(1) - slant::local(g.active()).array();

    // dz_ℐ, and x = K⁻¹(F₁ + J_ℐᵀdz_ℐ)
    slant::local(p.multipliers) = -slant::local(p.inactive).cwiseProduct(f2);
    slant::local(p.force) = f1;
    J.apply_adjoint_add(S(1), p.multipliers, p.force);
    p.factors.solve(p.force, p.x, p.w);
    J.apply(p.x, p.reduced);
    slant::local(p.reduced) =
        slant::local(p.active).cwiseProduct(f2 * (S(1) / S(g.rho())) + slant::local(p.reduced));
    if (!detail::is_finite(S(norm(p.reduced)))) return detail::no_factors(request, dy);
    auto symmetric = request;
    symmetric.residual_norm /= S(g.rho());  // the active rows were divided by ρ
    auto report = inner.solve(schur(g, p), p.reduced, symmetric, p.multipliers, prepared.krylov);
    slant::local(p.multipliers) -= slant::local(p.inactive).cwiseProduct(f2);
    slant::local(p.force) = f1;
    J.apply_adjoint_add(S(1), p.multipliers, p.force);
    p.factors.solve(p.force, p.x, p.w);
    report.operator_applications += 2;
    report.factorizations = 1;
    detail::finish_direction(g, f, request, dy, p, report);
    return report;
  }

  /// What is missing, in words.
  template <class G, class V>
  static consteval void refuse() {
    static_assert(detail::factorable_saddle<G, V>,
                  "schur_cg: F°(y) must be that of slant::kkt with an Eigen matrix A");
  }

 private:
  /// D(ℐ) + D(𝒜) J K⁻¹Jᵀ D(𝒜), which refers to g and p.
  template <class G, class P>
  [[nodiscard]] static auto schur(G const& g, P const& p) {
    auto const& J = g.jacobian();
    return declare<self_adjoint, positive_definite>(
        sum(detail::diagonal_view(p.inactive),
            congruence(product(detail::diagonal_view(p.active), J),
                       detail::factored_inverse(p.factors, J.cols()))));
  }
};

}  // namespace slant
