// SPDX-License-Identifier: MIT
//
// Block vectors and block matrices of slant/multilevel/ as those of Eigen, for the tests.
#pragma once

#include <slant/multilevel/block_matrix.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace test {

/// As a block vector; what does not count is garbage.
template <int N, class T>
std::vector<T> packed(Eigen::VectorXd const& x) {
  constexpr int stride = slant::block_matrix<N, T>::stride;
  std::vector<T> p(static_cast<std::size_t>(x.size() / N * stride), T(1e30));
  for (Eigen::Index k = 0; k < x.size(); ++k)
    p[static_cast<std::size_t>(k / N * stride + k % N)] = T(x[k]);
  return p;
}

template <int N, class T>
Eigen::VectorXd unpacked(std::vector<T> const& p) {
  constexpr int stride = slant::block_matrix<N, T>::stride;
  Eigen::VectorXd x(static_cast<Eigen::Index>(p.size()) / stride * N);
  for (Eigen::Index k = 0; k < x.size(); ++k)
    x[k] = double(p[static_cast<std::size_t>(k / N * stride + k % N)]);
  return x;
}

/// The diagonal blocks of a matrix as the inverses that sweeps take.
template <int N, class T>
std::vector<T> block_inverses(Eigen::MatrixXd const& D) {
  constexpr int stride = slant::block_matrix<N, T>::stride;
  std::vector<T> p(static_cast<std::size_t>(D.rows() * stride), T(0));
  for (Eigen::Index j = 0; j < D.rows(); ++j) {
    for (Eigen::Index q = 0; q < N; ++q)
      p[static_cast<std::size_t>(j * stride + q)] = T(D(j / N * N + q, j));
  }
  return p;
}

template <int N, class T>
Eigen::MatrixXd dense(slant::block_matrix<N, T> const& A) {
  using vector = Eigen::Matrix<T, Eigen::Dynamic, 1>;
  Eigen::MatrixXd m(A.rows(), A.rows());
  vector y(A.rows());
  for (Eigen::Index j = 0; j < A.rows(); ++j) {
    A.apply(vector(vector::Unit(A.rows(), j)), y);
    m.col(j) = y.template cast<double>();
  }
  return m;
}

}  // namespace test
