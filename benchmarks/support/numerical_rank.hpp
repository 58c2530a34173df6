// SPDX-License-Identifier: MIT
//
// The rank of a matrix up to rounding, by a dense factorisation with pivots.
#pragma once

#include <Eigen/QR>
#include <Eigen/SparseCore>

namespace benchmarks {

/// Pivots above n ε times the largest; −1 for a matrix larger than `most`, where n³ takes too long.
[[nodiscard]] inline Eigen::Index numerical_rank(Eigen::SparseMatrix<double> const& A,
                                                 Eigen::Index most) {
  if (A.rows() > most) return -1;
  return Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(Eigen::MatrixXd(A)).rank();
}

}  // namespace benchmarks
