// SPDX-License-Identifier: MIT
//
// Eigen's sparse LU as a value that can be copied, as states are: a copy begins without factors,
// which every Newton step computes anew.
#pragma once

#include <slant/concepts/vector.hpp>

#include <Eigen/SparseLU>

#include <memory>

namespace slant::detail {

/// Factors of a sparse matrix.
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

}  // namespace slant::detail
