// SPDX-License-Identifier: MIT
#include "krylov/spd_matrices.hpp"

#include <Eigen/Dense>

#include <random>

namespace test {

Eigen::MatrixXd with_spectrum(Eigen::VectorXd const& eigenvalues, unsigned seed) {
  auto const n = eigenvalues.size();
  std::mt19937 generator(seed);
  std::normal_distribution<double> gaussian;
  Eigen::MatrixXd g(n, n);
  for (auto& e : g.reshaped()) e = gaussian(generator);
  Eigen::MatrixXd const q = Eigen::HouseholderQR<Eigen::MatrixXd>(g).householderQ();
  Eigen::MatrixXd const a = q * eigenvalues.asDiagonal() * q.transpose();
  return (a + a.transpose()) / 2;
}

}  // namespace test
