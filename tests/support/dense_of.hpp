// SPDX-License-Identifier: MIT
#pragma once

#include <slant/concepts/linear_operator.hpp>

#include <Eigen/Core>

namespace test {

/// The matrix of an operator, column by column.
[[nodiscard]] Eigen::MatrixXd dense_of(auto const& op) {
  Eigen::MatrixXd m(op.rows(), op.cols());
  for (Eigen::Index j = 0; j < op.cols(); ++j) {
    Eigen::VectorXd const e = Eigen::VectorXd::Unit(op.cols(), j);
    Eigen::VectorXd y(op.rows());
    auto w = slant::workspace(op, e);
    slant::apply(op, e, y, w);
    m.col(j) = y;
  }
  return m;
}

}  // namespace test
