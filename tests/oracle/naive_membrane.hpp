// SPDX-License-Identifier: MIT
//
// Membranes the slow way: a dense matrix from triangles one by one.
#pragma once

#include <Eigen/Core>

namespace oracle {

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

}  // namespace oracle
