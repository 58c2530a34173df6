// SPDX-License-Identifier: MIT
//
// Sparse Cholesky by CHOLMOD of SuiteSparse, for symmetric positive definite matrices of doubles:
// supernodal LLᵀ where that pays, else LDLᵀ. On large meshes in 3D it is many times faster than
// ldlt. Exists only where SLANT_HAS_CHOLMOD is defined to 1 (the CMake target slant::cholmod does
// it).
//
// As in ldlt.hpp, K / 2^e is factored: exact, and necessary, because the square roots of LLᵀ would
// make the last bits depend on the units.
#pragma once

#if defined(SLANT_HAS_CHOLMOD) && SLANT_HAS_CHOLMOD

#include <slant/concepts/factorization.hpp>
#include <slant/factorizations/detail/cholmod_handles.hpp>
#include <slant/factorizations/detail/cholmod_workspace.hpp>
#include <slant/factorizations/detail/spd_checks.hpp>

#include <Eigen/SparseCore>

#include <cmath>
#include <concepts>
#include <memory>
#include <string_view>
#include <type_traits>
#include <vector>

namespace slant {

/// P K Pᵀ = 2^e L Lᵀ. Copies share the factors, which never change.
class cholmod {
 public:
  using scalar = double;
  using matrix_type = Eigen::SparseMatrix<double>;
  static constexpr law_set laws = slant::laws<slant::self_adjoint, slant::positive_definite>;

  /// Throws bad_input if K is not square, has an entry that is NaN or infinite, is not symmetric
  /// (up to 1024 ε, naming the worst pair), or not definite (naming the pivot).
  template <class M>
    requires std::same_as<typename M::Scalar, double>
  explicit cholmod(Eigen::SparseMatrixBase<M> const& k) {
    factor(k, [](cholmod_sparse& view) { return std::make_shared<factors>(view); });
  }
  /// The same with the unknowns eliminated in this order (position → unknown), or one that CHOLMOD
  /// finds better for memory without more fill; always supernodal. Throws bad_input also if order
  /// is not a permutation of 0 … rows − 1.
  template <class M>
    requires std::same_as<typename M::Scalar, double>
  cholmod(Eigen::SparseMatrixBase<M> const& k, std::vector<int> const& order) {
    detail::check_permutation("order", order, k.rows());
    factor(k,
           [&order](cholmod_sparse& view) { return std::make_shared<factors>(view, order, true); });
  }
  /// The factorisation of another matrix of the same size, with the ordering of this one: what
  /// takes longest to find is reused when only values have changed. Throws bad_input as the
  /// constructor.
  template <class M>
    requires std::same_as<typename M::Scalar, double>
  [[nodiscard]] cholmod refactorized(Eigen::SparseMatrixBase<M> const& k) const {
    slant::detail::check_size("rows of K", index(k.rows()), rows_, "as before,");
    cholmod result;
    result.factor(k, [this](cholmod_sparse& view) {
      return std::make_shared<factors>(view, factors_->order(), supernodal());
    });
    return result;
  }

  [[nodiscard]] index rows() const { return rows_; }
  /// What computes: "cholmod".
  [[nodiscard]] std::string_view name() const noexcept { return "cholmod"; }
  /// Whether dense blocks (supernodes) are used.
  [[nodiscard]] bool supernodal() const noexcept {
    return rows_ > 0 && factors_->get()->is_super != 0;
  }
  /// Entries of L.
  [[nodiscard]] double entries() const noexcept { return rows_ > 0 ? factors_->entries() : 0; }
  /// The power of two u with P K Pᵀ = L Lᵀ / u.
  [[nodiscard]] double unit() const noexcept { return unit_; }
  /// L itself, for those who know CHOLMOD; null for the empty matrix.
  [[nodiscard]] std::shared_ptr<detail::cholmod_factors const> const& handle() const noexcept {
    return factors_;
  }

  /// All that a solve needs: CHOLMOD's own state and vectors. One for each thread.
  template <class X>
    requires std::same_as<scalar_t<X>, double>
  [[nodiscard]] detail::cholmod_workspace workspace(X const& b) const {
    return detail::cholmod_workspace(factors_.get(), slant::local(b).cols());
  }
  /// x = K⁻¹ b for as many right-hand sides as w was made for. Throws bad_input if b or x has not
  /// rows() rows.
  template <class X, class Y>
    requires std::same_as<scalar_t<X>, double>
  void solve(X const& b, Y& x, detail::cholmod_workspace& w) const {
    detail::check_solve(rows(), b, x);
    if (rows_ == 0) return;
    w.right_hand_side() = slant::local(b);
    slant::local(x).noalias() = unit_ * w.solve(*factors_);
  }
  /// The same once, for those who will not solve again.
  template <class X, class Y>
    requires std::same_as<scalar_t<X>, double>
  void solve(X const& b, Y& x) const {
    detail::cholmod_workspace w(factors_.get(), slant::local(b).cols(), false);
    solve(b, x, w);
  }

 private:
  using factors = detail::cholmod_factors;

  cholmod() = default;

  /// make(view) factors the matrix; nothing is kept if it throws.
  template <class M, class Make>
  void factor(Eigen::SparseMatrixBase<M> const& matrix, Make make) {
    matrix_type k = matrix.derived();
    detail::require_symmetric_matrix("K", k);
    exponent_ = detail::scale_exponent(k);
    unit_ = detail::power_of_two<double>(-exponent_);
    k *= unit_;
    k.makeCompressed();
    rows_ = k.rows();
    if (rows_ == 0) return;
    cholmod_sparse view = detail::cholmod_view(k);
    std::shared_ptr<factors> const made = make(view);
    Eigen::VectorXd const diagonal = k.diagonal();
    auto const require = [&](index i, double pivot) {
      index const row = made->original_row(i);
      detail::require_positive_pivot("K", rows_, i, row, pivot, diagonal[row], exponent_);
    };
    made->for_each_pivot(require);
    if (index const i = made->failed_column(); i < rows_) {
      index const row = made->original_row(i);
      double const pivot = made->failed_pivot(diagonal[row]);
      require(i, pivot);
      detail::refuse_pivot("K", i, row, std::ldexp(pivot, exponent_), true);
    }
    factors_ = made;
  }

  int exponent_ = 0;
  double unit_ = 1;
  index rows_ = 0;
  std::shared_ptr<detail::cholmod_factors const> factors_;  // null for the empty matrix
};

}  // namespace slant

#endif
