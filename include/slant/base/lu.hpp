// SPDX-License-Identifier: MIT
//
// LU factorisations of Eigen as values that can be copied: sparse and dense.
#pragma once

#include <slant/concepts/vector.hpp>

#include <Eigen/LU>
#include <Eigen/SparseLU>

#include <memory>

namespace slant::detail {

/// Eigen's LU of a sparse matrix. A copy begins without factors, which every Newton step computes
/// anew.
template <class S>
class sparse_lu {
 public:
  static constexpr index factorizations = 1;
  using matrix_type = Eigen::SparseMatrix<S>;

  sparse_lu() : factors_(std::make_unique<factors_type>()) {}
  sparse_lu(sparse_lu const&) : sparse_lu() {}
  sparse_lu(sparse_lu&&) noexcept = default;
  sparse_lu& operator=(sparse_lu const&) { return *this = sparse_lu(); }
  sparse_lu& operator=(sparse_lu&&) noexcept = default;
  ~sparse_lu() = default;

  /// False if the matrix is singular, or has an entry that is not a number.
  [[nodiscard]] bool factor(matrix_type const& m) {
    if (m.rows() == 0) return true;
    for (index k = 0; k < index(m.outerSize()); ++k) {
      bool empty = true;
      for (typename matrix_type::InnerIterator entry(m, k); entry; ++entry) {
        if (!is_finite(S(entry.value()))) return false;
        empty = false;
      }
      if (empty) return false;  // Eigen may not come back from such a matrix
    }
    factors_->compute(m);
    return factors_->info() == Eigen::Success;
  }
  /// x = M⁻¹ b.
  template <class V>
  void solve(V const& b, V& x) const {
    if (slant::local(b).size() > 0) slant::local(x) = factors_->solve(slant::local(b));
  }

 private:
  using factors_type = Eigen::SparseLU<matrix_type, Eigen::COLAMDOrdering<int>>;

  std::unique_ptr<factors_type> factors_;
};

/// P G = L U of n × n operators with columns, in memory that is made once.
template <class S>
class dense_lu {
  using matrix_type = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;

 public:
  static constexpr index factorizations = 1;

  explicit dense_lu(index n) : matrix_(n, n), factors_(n) {}

  /// False if a pivot is zero or not a number.
  [[nodiscard]] bool factor(auto const& g) {
    if (matrix_.size() == 0) return true;
    g.columns(0, matrix_);
    factors_.compute(matrix_);
    auto const& lu = factors_.matrixLU();
    for (index i = 0; i < index(lu.rows()); ++i) {
      if (lu(i, i) == S(0) || !is_finite(S(lu(i, i)))) return false;
    }
    return true;
  }
  /// x = G⁻¹ b.
  template <class V>
  void solve(V const& b, V& x) const {
    if (matrix_.size() > 0) slant::local(x) = factors_.solve(slant::local(b));
  }
  /// y = G x, by the matrix.
  template <class V>
  void multiply(V const& x, V& y) const {
    slant::local(y).noalias() = matrix_ * slant::local(x);
  }

 private:
  matrix_type matrix_;
  Eigen::PartialPivLU<matrix_type> factors_;
};

}  // namespace slant::detail
