// SPDX-License-Identifier: MIT
//
// What the two Schur complement solvers of generalised saddle-point systems share.
#pragma once

#include <slant/concepts/vector_algebra.hpp>
#include <slant/newton/detail/hessian_factors.hpp>
#include <slant/newton/direction.hpp>
#include <slant/operators/diagonal.hpp>
#include <slant/operators/matrix.hpp>
#include <slant/operators/slice.hpp>
#include <slant/slanting/kkt_function.hpp>

#include <type_traits>
#include <utility>

namespace slant::detail {

template <class G>
concept has_hessian_matrix = is_kkt_operator<G> && requires(G const& g) {
  requires eigen_matrix<decltype(g.hessian().get())>;
};

/// F°(y) of a kkt_function whose A is a matrix.
template <class G, class V>
concept factorable_saddle = has_hessian_matrix<G> && linear_operator<G, V>;

/// Vectors and factors of a Schur complement solver, apart from what its inner iteration keeps.
template <class V, class Factors, class W>
struct schur_workspace {
  Factors factors;                  ///< of K = A + H
  V force;                          ///< n entries, right-hand side of K x = …
  V x;                              ///< n entries, K⁻¹ force
  V reduced;                        ///< p entries, right-hand side of the Schur complement
  V multipliers;                    ///< p entries, dz
  V active;                         ///< p entries, 1 in 𝒜 (times ρ in variant A)
  V inactive;                       ///< p entries, 1 in ℐ
  V residual;                       ///< F + G dy
  W g_workspace;                    ///< temporaries of G
  typename Factors::vector_type w;  ///< temporaries of a solve
};

template <class G>
using hessian_matrix_t = std::remove_cvref_t<decltype(std::declval<G const&>().hessian().get())>;

template <class G, class V>
[[nodiscard]] auto make_schur_workspace(G const& g, V const& f) {
  index const n = g.jacobian().cols();
  index const p = g.jacobian().rows();
  using factors = hessian_factors_t<hessian_matrix_t<G>>;
  auto g_workspace = slant::workspace(g, f);
  schur_workspace<V, factors, decltype(g_workspace)> w{{},
                                                       like(f, n),
                                                       like(f, n),
                                                       like(f, p),
                                                       like(f, p),
                                                       like(f, p),
                                                       like(f, p),
                                                       like(f, p),
                                                       std::move(g_workspace),
                                                       typename factors::vector_type(n)};
  w.residual = like(f, n + p);
  for (V* v : {&w.reduced, &w.multipliers, &w.active, &w.inactive}) vectors::set_zero(*v);
  return w;
}

/// With what the inner iteration keeps.
template <class Common, class Krylov>
struct schur_krylov_workspace {
  Common common;
  Krylov krylov;
};

/// diag(v), referring to v.
template <class V>
[[nodiscard]] auto diagonal_view(V const& v) {
  return diagonal_operator<V const&>(held<V const&>(v));
}

/// dy = (−x − K⁻¹Jᵀdz', dz) where x and dz' stand in p, and dz where dz' was completed; then its
/// residual, one application of G. The report is that of the inner iteration for dz'.
template <class G, class V, class P>
void finish_direction(G const& g, V const& f, direction_request<scalar_t<V>> const& request, V& dy,
                      P& p, direction_report<scalar_t<V>>& report) {
  using S = scalar_t<V>;
  index const n = g.jacobian().cols();
  index const m = g.jacobian().rows();
  slice(n + m, 0, n).segment(dy) = -slant::local(p.x);
  slice(n + m, n, m).segment(dy) = slant::local(p.multipliers);
  slant::apply(g, dy, p.residual, p.g_workspace);
  vectors::add(f, p.residual);
  S const true_norm = norm(p.residual);
  if (!is_finite(true_norm) || !is_finite(S(norm(dy)))) {
    report.status = status::breakdown;
    report.residual_norm = request.residual_norm;
    vectors::set_zero(dy);
    return;
  }
  // The rounding errors of K⁻¹ count as well.
  bool const enough = true_norm <= S(2) * request.tolerance * request.residual_norm;
  if (report.status == status::converged && !enough) report.status = status::stalled;
  report.residual_norm = true_norm;
}

/// What is reported where K has no factors of the kind wanted: no direction.
template <class V>
[[nodiscard]] direction_report<scalar_t<V>> no_factors(
    direction_request<scalar_t<V>> const& request, V& dy) {
  vectors::set_zero(dy);
  return {status::breakdown, request.residual_norm, 0, 0, 1};
}

}  // namespace slant::detail
