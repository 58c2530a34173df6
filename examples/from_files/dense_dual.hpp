// SPDX-License-Identifier: MIT
//
// The dual problem with A = B K⁻¹Bᵀ formed, for the methods of [T], which factor A + diagonal.
#pragma once

#include <Eigen/Core>
#include <slant/concepts/linear_operator.hpp>
#include <slant/operators/matrix.hpp>
#include <slant/problems/separable_qp.hpp>

#include "any_dual.hpp"

namespace from_files {

/// Refers to the dual problem. One product with A for each multiplier, counted by products().
class dense_dual {
 public:
  explicit dense_dual(any_dual const& dual) : dual_(&dual) {
    auto const& operator_a = dual.a();
    slant::index const n = operator_a.rows();
    A_.resize(n, n);
    Eigen::VectorXd column(n);
    auto w = slant::workspace(operator_a, column);
    for (slant::index j = 0; j < n; ++j) {
      slant::apply(operator_a, Eigen::VectorXd(Eigen::VectorXd::Unit(n, j)), column, w);
      A_.col(j) = column;
    }
    A_ = (0.5 * (A_ + A_.transpose())).eval();
  }

  [[nodiscard]] auto qp() const {
    return slant::separable_qp{slant::matrix<slant::self_adjoint, slant::positive_definite>(A_),
                               dual_->b(), dual_->set()};
  }
  [[nodiscard]] slant::index products() const { return A_.cols(); }
  /// Mean of the diagonal.
  [[nodiscard]] double mean() const { return A_.diagonal().mean(); }

 private:
  any_dual const* dual_;
  Eigen::MatrixXd A_;
};

}  // namespace from_files
