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

/// All data as correctly rounded numbers of the scalar S.
template <class S>
using vector = Eigen::Matrix<S, Eigen::Dynamic, 1>;

template <class S = double>
[[nodiscard]] Eigen::SparseMatrix<S> matrix() {
  Eigen::SparseMatrix<S> A(12, 12);
  for (int i = 0; i < 12; ++i) {
    A.insert(i, i) = S(4);
    if (i == 0) continue;
    A.insert(i, i - 1) = S(-1);
    A.insert(i - 1, i) = S(-1);
  }
  A.makeCompressed();
  return A;
}

/// b = A y: y would be the solution if no disc constrained it.
template <class S = double>
[[nodiscard]] vector<S> right_hand_side() {
  using std::sqrt;
  vector<S> y(12);
  y << S(2), S(1), S(1) / S(2), S(0), S(0), S(11), S(1) / S(100000), S(-1), sqrt(S(2)),
      S(-1) / S(10), S(41) / S(100000), S(143);
  return matrix<S>() * y;
}

template <class S = double>
[[nodiscard]] vector<S> radii() {
  vector<S> g(6);
  g << S(2), S(1), S(1) / S(2), S(2), S(1) / S(1000), S(154);
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
