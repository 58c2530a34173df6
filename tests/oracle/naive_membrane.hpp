// SPDX-License-Identifier: MIT
//
// Obstacle problems the slow way: a dense matrix from triangles one by one, and the projected
// Gauss–Seidel method, which minimises over one node after the other.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace oracle {

using long_vector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;
using long_matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

/// ∫ w ∇φ_k·∇φ_l on the triangles that halve the cells of a grid of nx × ny interior nodes, ∫ w by
/// the mean of the vertices. Node (i, j), from 1, is unknown (i − 1) + nx (j − 1).
template <class Weight>
[[nodiscard]] long_matrix naive_stiffness(int nx, int ny, long double width, long double height,
                                          Weight const& w) {
  long double const hx = width / (nx + 1);
  long double const hy = height / (ny + 1);
  long_matrix A = long_matrix::Zero(nx * ny, nx * ny);
  auto const unknown = [&](int i, int j) {
    return i < 1 || j < 1 || i > nx || j > ny ? -1 : (i - 1) + nx * (j - 1);
  };
  // The corner with the right angle, and the neighbours of it.
  auto const add_triangle = [&](int i, int j, int side) {
    int const nodes[3] = {unknown(i, j), unknown(i + side, j), unknown(i, j + side)};
    long double const gradients[3][2] = {{-1 / hx, -1 / hy}, {1 / hx, 0}, {0, 1 / hy}};
    long double const mean = (2 * w(i * hx) + w((i + side) * hx)) / 3;
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l < 3; ++l)
        if (nodes[k] >= 0 && nodes[l] >= 0)
          A(nodes[k], nodes[l]) +=
              hx * hy / 2 * mean *
              (gradients[k][0] * gradients[l][0] + gradients[k][1] * gradients[l][1]);
  };
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i) {
      add_triangle(i, j, 1);
      add_triangle(i + 1, j + 1, -1);
    }
  return A;
}

/// min ½ vᵀA v − bᵀv over l ≤ v ≤ u, A definite: sweeps until nothing changes but the last digits.
[[nodiscard]] inline long_vector projected_gauss_seidel(long_matrix const& A, long_vector const& b,
                                                        long_vector const& l,
                                                        long_vector const& u) {
  long_vector v = long_vector::Zero(b.size()).cwiseMax(l).cwiseMin(u);
  for (int sweep = 0; sweep < 100000; ++sweep) {
    long double change = 0;
    for (Eigen::Index k = 0; k < v.size(); ++k) {
      long double const free = v[k] + (b[k] - A.col(k).dot(v)) / A(k, k);
      long double const next = std::min(u[k], std::max(l[k], free));
      change = std::max(change, std::fabs(next - v[k]));
      v[k] = next;
    }
    if (change <= 1e-17L * v.cwiseAbs().maxCoeff()) break;
  }
  return v;
}

}  // namespace oracle
