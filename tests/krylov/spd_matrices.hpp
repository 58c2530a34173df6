// SPDX-License-Identifier: MIT
//
// Symmetric matrices with a prescribed spectrum, and a dense solve as the oracle.
#pragma once

#include <slant/operators/matrix.hpp>

#include <operators/dense_oracle.hpp>

#include <utility>

namespace test {

/// Q diag(eigenvalues) Qᵀ with a random orthogonal Q, symmetric to the last bit.
Eigen::MatrixXd with_spectrum(Eigen::VectorXd const& eigenvalues, unsigned seed = 1);

/// n numbers from 1/κ to 1, equally spaced in their logarithms.
inline Eigen::VectorXd log_spaced(Eigen::Index n, double κ) {
  return (Eigen::ArrayXd::LinSpaced(n, -std::log(κ), 0)).exp().matrix();
}

inline Eigen::VectorXd random_vector(Eigen::Index n, unsigned seed = 2) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> gaussian;
  Eigen::VectorXd v(n);
  for (auto& e : v) e = gaussian(generator);
  return v;
}

/// The matrix as an operator that promises to be symmetric positive definite.
template <class M>
auto spd(M&& m) {
  return slant::matrix<slant::self_adjoint, slant::positive_definite>(std::forward<M>(m));
}

}  // namespace test
