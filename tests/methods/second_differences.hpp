// SPDX-License-Identifier: MIT
//
// The matrix of second differences: definite, and worse conditioned the larger it is.
#pragma once

#include <Eigen/Core>

namespace test {

/// 2 on the diagonal, −1 beside it.
inline Eigen::MatrixXd second_differences(Eigen::Index n) {
  Eigen::MatrixXd a = 2 * Eigen::MatrixXd::Identity(n, n);
  a.diagonal(1).setConstant(-1);
  a.diagonal(-1).setConstant(-1);
  return a;
}

}  // namespace test
