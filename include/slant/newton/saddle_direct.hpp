// SPDX-License-Identifier: MIT
//
// The generalised saddle-point system [T (2.13)] assembled and solved by sparse LU with pivoting:
// [T]'s "algorithm as it is, without any adjustments", which needs neither definiteness nor an
// inner iteration. For a matrix A with few entries.
#pragma once

#include <slant/concepts/vector_algebra.hpp>
#include <slant/newton/detail/schur_reduction.hpp>
#include <slant/newton/detail/sparse_lu.hpp>

#include <Eigen/SparseCore>

#include <utility>
#include <vector>

namespace slant {

/// What saddle_direct keeps.
template <class V, class W>
struct saddle_direct_workspace {
  detail::sparse_lu<scalar_t<V>> factors;
  std::vector<Eigen::Triplet<scalar_t<V>>> entries;
  V residual;     ///< F + G dy
  W g_workspace;  ///< temporaries of G
};

/// Sparse LU of F°(y) of a kkt_function whose A is a matrix. Allocates in each solve.
struct saddle_direct {
  [[gnu::cold]] void validate() const {}

  template <class G, class V>
    requires detail::factorable_saddle<G, V>
  [[nodiscard]] auto prepare(G const& g, V const& f) const {
    auto w = slant::workspace(g, f);
    return saddle_direct_workspace<V, decltype(w)>{
        {}, {}, like(f, slant::local(f).size()), std::move(w)};
  }

  template <class G, class V, class P>
    requires detail::factorable_saddle<G, V>
  direction_report<scalar_t<V>> solve(G const& g, V const& f,
                                      direction_request<scalar_t<V>> const& request, V& dy,
                                      P& p) const {
    using S = scalar_t<V>;
    direction_report<S> report{status::breakdown, request.residual_norm, 0, 1, 1};
    if (p.factors.factor(assembled<S>(g, p.entries))) {
      p.factors.solve(f, dy);
      vectors::negate(dy, dy);
      slant::apply(g, dy, p.residual, p.g_workspace);
      vectors::add(f, p.residual);
      S const residual_norm = norm(p.residual);
      if (detail::is_finite(residual_norm)) {
        bool const enough = residual_norm <= request.tolerance * request.residual_norm;
        report.residual_norm = residual_norm;
        report.status = enough ? status::converged : status::stalled;
        return report;
      }
    }
    vectors::set_zero(dy);
    return report;
  }

  /// What is missing, in words.
  template <class G, class V>
  static consteval void refuse() {
    static_assert(detail::factorable_saddle<G, V>,
                  "saddle_direct: F°(y) must be that of slant::kkt with an Eigen matrix A");
  }

 private:
  template <class S, class G>
  [[nodiscard]] static Eigen::SparseMatrix<S> assembled(G const& g,
                                                        std::vector<Eigen::Triplet<S>>& entries) {
    index const n = g.jacobian().cols();
    index const m = g.jacobian().rows();
    entries.clear();
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
