// SPDX-License-Identifier: MIT
//
// LDLᵀ of K = A + H [T §3.3.3], A a matrix that stays and H = Σ zᵢ ∇²fᵢ(x) of a few diagonal blocks
// that change. K need not be definite: a negative multiplier makes H so. No pivoting in the sparse
// case, as in [T]; what that costs in accuracy shows in the residual of the Newton direction.
//
// Copies begin without factors, as those of sparse_lu do.
#pragma once

#include <slant/concepts/checks.hpp>
#include <slant/concepts/laws.hpp>
#include <slant/factorizations/detail/sparse_ldlt_factors.hpp>

#include <Eigen/Cholesky>
#include <Eigen/SparseCore>

#include <memory>
#include <type_traits>
#include <vector>

namespace slant::detail {

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
    a_ = a + room;
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
using hessian_factors_t = std::conditional_t<std::is_base_of_v<Eigen::SparseMatrixBase<M>, M>,
                                             sparse_hessian_factors<typename M::Scalar>,
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

}  // namespace slant::detail
