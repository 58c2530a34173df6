// SPDX-License-Identifier: MIT
//
// A dense matrix taken from the columns of an operator, and its LU factors, in memory that is made
// once.
#pragma once

#include <slant/concepts/vector.hpp>

#include <Eigen/LU>

namespace slant::detail {

/// P G = L U of n × n operators with columns.
template <class S>
class dense_lu {
  using matrix_type = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;

 public:
  static constexpr index factorizations = 1;

  explicit dense_lu(index n) : matrix_(n, n), factors_(n) {}

  /// False if a pivot is zero or not a number.
  template <class G>
  [[nodiscard]] bool factor(G const& g) {
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
