// SPDX-License-Identifier: MIT
//
// Linear solvers of Newton's method for generalised saddle-point systems: by the Schur complement
// with CG or BiCGSTAB, and direct.
#pragma once

#include <slant/base/lu.hpp>
#include <slant/base/matrix_entries.hpp>
#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/laws.hpp>
#include <slant/factorizations/ldlt.hpp>
#include <slant/newton/direct_solver.hpp>
#include <slant/newton/direction.hpp>
#include <slant/newton/krylov_solvers.hpp>
#include <slant/operators/block.hpp>
#include <slant/operators/declare.hpp>
#include <slant/operators/diagonal.hpp>
#include <slant/operators/matrix.hpp>
#include <slant/operators/product.hpp>
#include <slant/operators/restriction.hpp>
#include <slant/operators/sum.hpp>
#include <slant/slanting/kkt_function.hpp>

#include <Eigen/Cholesky>
#include <Eigen/SparseCore>

#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace slant::detail {

// --- hessian factors -----------------------------------------------------------------------------
//
// LDLᵀ of K = A + H [T §3.3.3], A a matrix that stays and H = Σ zᵢ ∇²fᵢ(x) of a few diagonal blocks
// that change. K need not be definite: a negative multiplier makes H so. No pivoting in the sparse
// case, as in [T]; what that costs in accuracy shows in the residual of the Newton direction.
//
// Copies begin without factors, as those of sparse_lu do.

/// What the pivots D tell: they have the signs of the eigenvalues.
enum class factored : unsigned char { failed, indefinite, definite };

template <class D>
[[nodiscard]] factored look_at_pivots(D const& pivots) {
  using S = typename D::Scalar;
  auto result = factored::definite;
  for (index i = 0; i < index(pivots.size()); ++i) {
    S const d = pivots[i];
    if (d == S(0) || !is_finite(d)) return factored::failed;
    if (d < S(0)) result = factored::indefinite;
  }
  return result;
}

/// For a sparse A. The pattern is analysed once.
template <class S>
class sparse_hessian_factors {
 public:
  using vector_type = Eigen::Matrix<S, Eigen::Dynamic, 1>;

  sparse_hessian_factors() : factors_(std::make_unique<sparse_ldlt_factors<S>>()) {}
  sparse_hessian_factors(sparse_hessian_factors const&) : sparse_hessian_factors() {}
  sparse_hessian_factors(sparse_hessian_factors&&) noexcept = default;
  sparse_hessian_factors& operator=(sparse_hessian_factors const&) {
    return *this = sparse_hessian_factors();
  }
  sparse_hessian_factors& operator=(sparse_hessian_factors&&) noexcept = default;
  ~sparse_hessian_factors() = default;

  template <class M, class Curvature>
  [[nodiscard]] factored factor(M const& a, Curvature const& curvature) {
    if (a.rows() == 0) return factored::definite;
    bool const first = k_.rows() == 0;
    if (first) make_pattern(a, curvature);
    k_ = a_;
    curvature.visit_hessian([&](index i, index j, S const& h) {
      if (h != S(0)) k_.coeffRef(i, j) += h;
    });
    if (first) factors_->analyzePattern(k_);
    factors_->factorize(k_);
    return factors_->info() == Eigen::Success ? look_at_pivots(factors_->pivots())
                                              : factored::failed;
  }
  /// Room for the permuted unknowns.
  [[nodiscard]] vector_type workspace() const { return vector_type(k_.rows()); }

  template <class B, class X>
  void solve(B const& b, X& x, vector_type& w) const {
    if (k_.rows() == 0) return;
    w.resize(k_.rows());
    w.noalias() = factors_->permutation() * slant::local(b);
    factors_->solve_in_place(w.data());
    slant::local(x).noalias() = factors_->permutation().transpose() * w;
  }

 private:
  /// A with room for H.
  template <class M, class Curvature>
  void make_pattern(M const& a, Curvature const& curvature) {
    std::vector<Eigen::Triplet<S>> places;
    curvature.visit_hessian_pattern([&](index i, index j, S const&) {
      places.emplace_back(static_cast<int>(i), static_cast<int>(j), S(0));
    });
    Eigen::SparseMatrix<S> room(a.rows(), a.cols());
    room.setFromTriplets(places.begin(), places.end());
    a_ = Eigen::SparseMatrix<S>(a) + room;
    k_ = a_;
  }

  Eigen::SparseMatrix<S> a_;
  Eigen::SparseMatrix<S> k_;
  std::unique_ptr<sparse_ldlt_factors<S>> factors_;
};

/// For a dense A.
template <class S>
class dense_hessian_factors {
  using matrix_type = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;

 public:
  using vector_type = Eigen::Matrix<S, Eigen::Dynamic, 1>;

  template <class M, class Curvature>
  [[nodiscard]] factored factor(M const& a, Curvature const& curvature) {
    if (a.rows() == 0) return factored::definite;
    k_ = a;
    curvature.visit_hessian([&](index i, index j, S const& h) { k_(i, j) += h; });
    factors_.compute(k_);
    return factors_.info() == Eigen::Success ? look_at_pivots(factors_.vectorD())
                                             : factored::failed;
  }
  [[nodiscard]] vector_type workspace() const { return {}; }

  template <class B, class X>
  void solve(B const& b, X& x, vector_type&) const {
    if (k_.rows() > 0) slant::local(x) = factors_.solve(slant::local(b));
  }

 private:
  matrix_type k_;
  Eigen::LDLT<matrix_type, Eigen::Lower> factors_;
};

/// The factors for matrices like M.
template <class M>
using hessian_factors_t =
    std::conditional_t<is_sparse_matrix<M>, sparse_hessian_factors<typename M::Scalar>,
                       dense_hessian_factors<typename M::Scalar>>;

/// K⁻¹ as an operator.
template <class Factors>
class factored_inverse {
 public:
  factored_inverse(Factors const& factors, index n) : factors_(&factors), n_(n) {}

  static constexpr law_set laws = slant::laws<slant::self_adjoint>;
  [[nodiscard]] index rows() const noexcept { return n_; }
  [[nodiscard]] index cols() const noexcept { return n_; }
  template <class X>
  [[nodiscard]] auto workspace(X const&) const {
    return typename Factors::vector_type(n_);
  }
  template <class X, class Y, class W>
  void apply(X const& x, Y& y, W& w) const {
    factors_->solve(x, y, w);
  }

 private:
  Factors const* factors_;
  index n_;
};

template <class G>
concept has_hessian_matrix = is_kkt_operator<G> && requires(G const& g) {
  requires eigen_matrix<decltype(g.hessian().get())>;
};

/// F°(y) of a kkt_function whose A is a matrix.
template <class G, class V>
concept factorable_saddle = has_hessian_matrix<G> && linear_operator<G, V>;

template <class G>
using hessian_matrix_t = std::remove_cvref_t<decltype(std::declval<G const&>().hessian().get())>;

/// Vectors and factors of a Schur complement solver, apart from what its inner iteration keeps.
template <class G, class V>
struct schur_workspace {
  using factors_type = hessian_factors_t<hessian_matrix_t<G>>;

  factors_type factors{};                ///< of K = A + H
  V force;                               ///< n entries, right-hand side of K x = …
  V x = force;                           ///< n entries, K⁻¹ force
  V reduced;                             ///< p entries, right-hand side of the Schur complement
  V multipliers = reduced;               ///< p entries, dz
  V active = reduced;                    ///< p entries, 1 in 𝒜 (times ρ in variant A)
  V inactive = reduced;                  ///< p entries, 1 in ℐ
  V residual;                            ///< F + G dy
  workspace_t<G, V> g_workspace;         ///< temporaries of G
  typename factors_type::vector_type w;  ///< temporaries of a solve

  schur_workspace(G const& g, V const& f)
      : force(like(f, g.jacobian().cols())),
        reduced(like(f, g.jacobian().rows())),
        residual(like(f, slant::local(f).size())),
        g_workspace(slant::workspace(g, f)),
        w(g.jacobian().cols()) {
    for (V* v : {&reduced, &multipliers, &active, &inactive}) vectors::set_zero(*v);
  }
};

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

/// dy = (−x, dz) for the dz in p, x = K⁻¹(F₁ + Jᵀdz); then its residual, one application of G. The
/// report is that of the inner iteration, after one solve and one factorisation of K.
template <class G, class V, class P>
void finish_direction(G const& g, V const& f, request_of<V> const& request, V& dy, P& p,
                      report_of<V>& report) {
  using S = scalar_t<V>;
  index const n = g.jacobian().cols();
  index const m = g.jacobian().rows();
  slant::local(p.force) = slice(n + m, 0, n).segment(f);
  g.jacobian().apply_adjoint_add(S(1), p.multipliers, p.force);
  p.factors.solve(p.force, p.x, p.w);
  report.operator_applications += 2;
  report.factorizations = 1;
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
  bool const enough = true_norm <= attainable(request.tolerance) * request.residual_norm;
  if (report.status == status::converged && !enough) report.status = status::stalled;
  report.residual_norm = true_norm;
}

/// What is reported where K has no factors of the kind wanted: no direction.
template <class V>
[[nodiscard]] report_of<V> no_factors(request_of<V> const& request, V& dy) {
  vectors::set_zero(dy);
  return {status::breakdown, request.residual_norm, 0, 0, 1};
}

/// The frame of the Schur complement solvers. Self::reduce(g, F₁, F₂, workspace) makes the
/// right-hand side of the operator Self::schur(g, workspace), of which the inner iteration finds
/// dz; if Self::symmetric K must be definite, and dz_𝒜 is found.
template <class Self, class Krylov>
struct schur_solver {
  Krylov inner{};

  [[gnu::cold]] void validate() const { inner.validate(); }

  template <class G, class V>
    requires factorable_saddle<G, V>
  [[nodiscard]] auto prepare(G const& g, V const& f) const {
    schur_workspace<G, V> common(g, f);
    auto krylov = inner.prepare(Self::schur(g, common), common.reduced);
    return schur_krylov_workspace<decltype(common), decltype(krylov)>{std::move(common),
                                                                      std::move(krylov)};
  }

  template <class G, class V, class P>
    requires factorable_saddle<G, V>
  report_of<V> solve(G const& g, V const& f, request_of<V> const& request, V& dy,
                     P& prepared) const {
    using S = scalar_t<V>;
    auto& p = prepared.common;
    index const n = g.jacobian().cols();
    index const m = g.jacobian().rows();
    auto const f1 = slice(n + m, 0, n).segment(f);
    auto const f2 = slice(n + m, n, m).segment(f);
    auto const pivots = p.factors.factor(g.hessian().get(), g.curvature());
    if (pivots == factored::failed || (Self::symmetric && pivots != factored::definite)) {
      return no_factors(request, dy);
    }
    slant::local(p.inactive) = S(1) - slant::local(g.active()).array();
    Self::reduce(g, f1, f2, p);
    if (!is_finite(S(norm(p.reduced)))) return no_factors(request, dy);
    auto reduced = request;
    if (Self::symmetric) reduced.residual_norm /= S(g.rho());  // as the active rows were
    auto report =
        inner.solve(Self::schur(g, p), p.reduced, reduced, p.multipliers, prepared.krylov);
    if (Self::symmetric) {
      slant::local(p.multipliers) -= slant::local(p.inactive).cwiseProduct(f2);  // dz_ℐ
    }
    finish_direction(g, f, request, dy, p, report);
    return report;
  }
};

}  // namespace slant::detail

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
  static constexpr bool symmetric = true;

  /// dz_ℐ, and what that leaves of the active rows.
  template <class G, class F1, class F2, class P>
  static void reduce(G const& g, F1 const& f1, F2 const& f2, P& p) {
    using S = typename F1::Scalar;
    auto const& J = g.jacobian();
    vectors::copy(g.active(), p.active);
    slant::local(p.multipliers) = -slant::local(p.inactive).cwiseProduct(f2);
    slant::local(p.force) = f1;
    J.apply_adjoint_add(S(1), p.multipliers, p.force);
    p.factors.solve(p.force, p.x, p.w);  // x = K⁻¹(F₁ + J_ℐᵀdz_ℐ)
    J.apply(p.x, p.reduced);
    slant::local(p.reduced) =
        slant::local(p.active).cwiseProduct(f2 * (S(1) / S(g.rho())) + slant::local(p.reduced));
  }

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
  static constexpr bool symmetric = false;

  template <class G, class F1, class F2, class P>
  static void reduce(G const& g, F1 const& f1, F2 const& f2, P& p) {
    vectors::scale(typename F1::Scalar(g.rho()), g.active(), p.active);
    p.factors.solve(f1, p.x, p.w);  // x = K⁻¹F₁
    g.jacobian().apply(p.x, p.reduced);
    slant::local(p.reduced) = f2 + slant::local(p.active).cwiseProduct(slant::local(p.reduced));
  }

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
  template <class G, class V>
    requires detail::factorable_saddle<G, V>
  [[nodiscard]] auto prepare(G const& g, V const& f) const {
    return detail::direct_workspace{detail::sparse_lu<scalar_t<V>>(),
                                    like(f, slant::local(f).size()), slant::workspace(g, f)};
  }

  template <class G, class V, class P>
    requires detail::factorable_saddle<G, V>
  report_of<V> solve(G const& g, V const& f, request_of<V> const& request, V& dy, P& p) const {
    return detail::direct_direction(g, f, request, dy, p, [&](V& x) {
      if (!p.factors.factor(assembled<scalar_t<V>>(g))) return false;
      p.factors.solve(f, x);
      return true;
    });
  }

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
    detail::for_each_entry(g.hessian().get(), put);
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
};

}  // namespace slant
