// SPDX-License-Identifier: MIT
//
// Example 1 of the lecture [K]: A = tridiag(−1, 4, −1) with 12 unknowns, b = A y, and six discs
// ‖(x_i, x_{i+6})‖ ≤ g_i, i = 1 … 6. The active set at the solution is {2, 3, 5}.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <array>
#include <cmath>

namespace example_1 {

/// Upper bound of the eigenvalues 4 + 2 cos(kπ/13) of A.
inline constexpr double largest_eigenvalue = 6;

[[nodiscard]] inline Eigen::SparseMatrix<double> matrix() {
  Eigen::SparseMatrix<double> A(12, 12);
  for (int i = 0; i < 12; ++i) {
    A.insert(i, i) = 4;
    if (i > 0) A.insert(i, i - 1) = A.insert(i - 1, i) = -1;
  }
  A.makeCompressed();
  return A;
}

/// b = A y: y would be the solution if no disc constrained it.
[[nodiscard]] inline Eigen::VectorXd right_hand_side() {
  Eigen::VectorXd y(12);
  y << 2, 1, 0.5, 0, 0, 11, 1e-5, -1, std::sqrt(2.0), -0.1, 4.1e-4, 143;
  return matrix() * y;
}

[[nodiscard]] inline Eigen::VectorXd radii() {
  Eigen::VectorXd g(6);
  g << 2, 1, 0.5, 2, 1e-3, 154;
  return g;
}

/// Products of KPRGP printed in [K] for an accuracy of about 1e−6.
struct printed_products {
  double Γ;
  int products;
};
inline constexpr std::array<printed_products, 11> printed{{{100, 30},
                                                           {10, 24},
                                                           {5, 21},
                                                           {1, 19},
                                                           {0.5, 20},
                                                           {0.4, 20},
                                                           {0.2, 22},
                                                           {0.1, 22},
                                                           {0.05, 26},
                                                           {0.01, 37},
                                                           {0.001, 50}}};

}  // namespace example_1
