// SPDX-License-Identifier: MIT
//
// An operator A = B K⁻¹Bᵀ (+ E) as a dense matrix, for libraries that want entries: K is factored
// once and solved with many right-hand sides at a time.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <algorithm>
#include <slant/concepts/factorization.hpp>

namespace benchmarks {

/// B K⁻¹Bᵀ, symmetric to the last bit, 128 columns at a time.
template <class Factorization>
[[nodiscard]] Eigen::MatrixXd dense_form(Eigen::SparseMatrix<double> const& B,
                                         Factorization const& factor) {
  Eigen::Index const n = B.rows();
  Eigen::Index const width = std::min<Eigen::Index>(n, 128);
  Eigen::SparseMatrix<double> const Bt = B.transpose();
  Eigen::MatrixXd A(n, n), loads(B.cols(), width), u(B.cols(), width);
  auto w = factor.workspace(loads);
  for (Eigen::Index j = 0; j < n; j += width) {
    Eigen::Index const columns = std::min(width, n - j);
    loads.setZero();
    loads.leftCols(columns) = Eigen::MatrixXd(Bt.middleCols(j, columns));
    factor.solve(loads, u, w);
    A.middleCols(j, columns).noalias() = B * u.leftCols(columns);
  }
  for (Eigen::Index j = 0; j < n; ++j)
    for (Eigen::Index i = 0; i < j; ++i) A(i, j) = A(j, i) = (A(i, j) + A(j, i)) / 2;
  return A;
}

}  // namespace benchmarks
