// SPDX-License-Identifier: MIT
//
// Linear solvers of Newton's method for generalised saddle-point systems: by the Schur complement
// with CG or BiCGSTAB, and direct.
#pragma once

#include <slant/base/lu.hpp>
#include <slant/base/vector_algebra.hpp>
#include <slant/newton/direct_solver.hpp>
#include <slant/newton/krylov_solvers.hpp>
#include <slant/newton/parts/schur_reduction.hpp>
#include <slant/operators/block.hpp>
#include <slant/operators/declare.hpp>
#include <slant/operators/diagonal.hpp>
#include <slant/operators/product.hpp>
#include <slant/operators/sum.hpp>

#include <Eigen/SparseCore>

#include <utility>
#include <vector>

namespace slant {

// --- schur cg ------------------------------------------------------------------------------------
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

/// CG on the symmetrised Schur complement; for F°(y) of a kkt_function whose A is a matrix, sparse
/// or dense. operator_applications are those of K⁻¹. Factorisations allocate.
struct schur_cg : detail::schur_solver<schur_cg, cg_solver> {
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
    detail::finish_direction(g, f, request, dy, p, report);
    return report;
  }

  /// What is missing, in words.
  template <class G, class V>
  static consteval void refuse() {
    static_assert(detail::factorable_saddle<G, V>,
                  "schur_cg: F°(y) must be that of slant::kkt with an Eigen matrix A");
  }

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

// --- schur bicgstab ------------------------------------------------------------------------------
//
// Variant A of [T §3.1, §3.3.1]: the same system reduced to its nonsymmetric Schur complement, with
// K = LDLᵀ factored in each Newton step and BiCGSTAB on
//
//     S dz = −F₂ − ρD(𝒜) J K⁻¹F₁,     S = D(ℐ) + ρD(𝒜) J K⁻¹Jᵀ;     dx = −K⁻¹(F₁ + Jᵀdz).
//
// Each product by S is one by K⁻¹, a "Hessian multiplication" of [T]; two more frame them.
// Breakdown if K is singular. It may be indefinite.

/// BiCGSTAB on the Schur complement; for the same F°(y), counted alike.
struct schur_bicgstab : detail::schur_solver<schur_bicgstab, bicgstab_solver> {
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
    detail::finish_direction(g, f, request, dy, p, report);
    return report;
  }

  /// What is missing, in words.
  template <class G, class V>
  static consteval void refuse() {
    static_assert(detail::factorable_saddle<G, V>,
                  "schur_bicgstab: F°(y) must be that of slant::kkt with an Eigen matrix A");
  }

  /// S, which refers to g and p.
  template <class G, class P>
  [[nodiscard]] static auto schur(G const& g, P const& p) {
    auto const& J = g.jacobian();
    return schur_complement(detail::factored_inverse(p.factors, J.cols()), J,
                            product(detail::diagonal_view(p.active), J),
                            detail::diagonal_view(p.inactive));
  }
};

// --- saddle direct -------------------------------------------------------------------------------
//
// The generalised saddle-point system [T (2.13)] assembled and solved by sparse LU with pivoting:
// [T]'s "algorithm as it is, without any adjustments", which needs neither definiteness nor an
// inner iteration. For a matrix A with few entries.

/// Sparse LU of F°(y) of a kkt_function whose A is a matrix. Allocates in each solve.
struct saddle_direct {
  [[gnu::cold]] void validate() const {}

  template <class G, class V>
    requires detail::factorable_saddle<G, V>
  [[nodiscard]] auto prepare(G const& g, V const& f) const {
    auto w = slant::workspace(g, f);
    return detail::direct_workspace<V, detail::sparse_lu<scalar_t<V>>, decltype(w)>{
        {}, like(f, slant::local(f).size()), std::move(w)};
  }

  template <class G, class V, class P>
    requires detail::factorable_saddle<G, V>
  direction_report<scalar_t<V>> solve(G const& g, V const& f,
                                      direction_request<scalar_t<V>> const& request, V& dy,
                                      P& p) const {
    return detail::direct_direction(g, f, request, dy, p, [&](V& x) {
      if (!p.factors.factor(assembled<scalar_t<V>>(g))) return false;
      p.factors.solve(f, x);
      return true;
    });
  }

  /// What is missing, in words.
  template <class G, class V>
  static consteval void refuse() {
    static_assert(detail::factorable_saddle<G, V>,
                  "saddle_direct: F°(y) must be that of slant::kkt with an Eigen matrix A");
  }

 private:
  template <class S, class G>
  [[nodiscard]] static Eigen::SparseMatrix<S> assembled(G const& g) {
    index const n = g.jacobian().cols();
    index const m = g.jacobian().rows();
    std::vector<Eigen::Triplet<S>> entries;
    auto const put = [&](index i, index j, S const& value) {
      entries.emplace_back(static_cast<int>(i), static_cast<int>(j), value);
    };
    put_matrix(g.hessian().get(), put);
    g.curvature().visit_hessian(put);
    g.jacobian().visit([&](index row, index component, S const& entry) {
      put(component, n + row, entry);
      put(n + row, component, -S(g.rho()) * slant::local(g.active())[row] * entry);
    });
    for (index i = 0; i < m; ++i) put(n + i, n + i, S(1) - slant::local(g.active())[i]);
    Eigen::SparseMatrix<S> matrix(n + m, n + m);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
  }
  template <class M, class Put>
  static void put_matrix(M const& a, Put const& put) {
    if constexpr (std::is_base_of_v<Eigen::SparseMatrixBase<M>, M>) {
      for (index k = 0; k < index(a.outerSize()); ++k) {
        for (typename M::InnerIterator e(a, k); e; ++e) put(e.row(), e.col(), e.value());
      }
    } else {
      for (index j = 0; j < index(a.cols()); ++j) {
        for (index i = 0; i < index(a.rows()); ++i) put(i, j, a(i, j));
      }
    }
  }
};

}  // namespace slant
