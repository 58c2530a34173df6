// SPDX-License-Identifier: MIT
//
// Operators against dense matrices: an operator is spelt out column by column and compared.
#pragma once

#include <slant/concepts/linear_operator.hpp>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <limits>
#include <random>

namespace test {

template <class S>
using dense = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;
template <class S>
using column = Eigen::Matrix<S, Eigen::Dynamic, 1>;

/// Entries from (−1, 1).
template <class S = double>
dense<S> random_dense(slant::index rows, slant::index cols, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> entry(-1, 1);
  dense<S> m(rows, cols);
  for (slant::index j = 0; j < cols; ++j)
    for (slant::index i = 0; i < rows; ++i) m(i, j) = S(entry(generator));
  return m;
}
template <class S = double>
column<S> random_column(slant::index n, unsigned seed) {
  return random_dense<S>(n, 1, seed);
}
/// About half of the entries are zero.
template <class S = double>
Eigen::SparseMatrix<S> random_sparse(slant::index rows, slant::index cols, unsigned seed) {
  dense<S> m = random_dense<S>(rows, cols, seed);
  for (auto& entry : m.reshaped())
    if (entry < S(0)) entry = S(0);
  return m.sparseView();
}
/// Symmetric positive definite with a moderate condition.
template <class S = double>
dense<S> random_spd(slant::index n, unsigned seed) {
  dense<S> const m = random_dense<S>(n, n, seed);
  dense<S> const product = m * m.transpose();
  dense<S> k = (product + dense<S>(product.transpose())) / S(2);
  k.diagonal().array() += S(1);
  return k;
}

/// The matrix of an operator, from apply alone.
template <class S = double, class A>
dense<S> spelt_out(A const& a) {
  dense<S> m(a.rows(), a.cols());
  column<S> y(a.rows());
  for (slant::index j = 0; j < a.cols(); ++j) {
    column<S> const e = dense<S>::Identity(a.cols(), a.cols()).col(j);
    y.setConstant(std::numeric_limits<S>::quiet_NaN());
    slant::apply(a, e, y);
    m.col(j) = y;
  }
  return m;
}

/// Whether the operator is that matrix, up to `roundings` ε relative to the largest entry.
template <class A, class M>
bool matches(A const& a, M const& expected, double roundings = 100) {
  using S = typename M::Scalar;
  dense<S> const wanted = expected;
  if (a.rows() != wanted.rows() || a.cols() != wanted.cols()) return false;
  dense<S> const difference = spelt_out<S>(a) - wanted;
  if (wanted.size() == 0) return true;
  S const size = wanted.cwiseAbs().maxCoeff();
  return difference.cwiseAbs().maxCoeff() <=
         S(roundings) * std::numeric_limits<S>::epsilon() * size;
}

}  // namespace test
