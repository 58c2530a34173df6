// SPDX-License-Identifier: MIT
//
// A matrix K, and a B that touches some of the unknowns of one of its sides.
#pragma once

#include <slant/contact/contact_data.hpp>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <support/dense_algebra.hpp>
#include <vector>

#include "factorizations/spd_examples.hpp"

namespace test {

/// Nodes of the bottom of the cube, two of three, each in a row of its own; and a row that couples
/// two.
struct condensation_scene {
  Eigen::SparseMatrix<double> K;
  Eigen::SparseMatrix<double> B;
  std::vector<slant::index> contact;

  explicit condensation_scene(int k) : K(grid_laplacian(k, 0.1)) {
    std::vector<Eigen::Triplet<double>> entries;
    int rows = 0;
    for (int i = 0; i < k * k; ++i) {
      if (i % 3 != 2) entries.emplace_back(rows++, i, 1.0 + 0.01 * i);
    }
    entries.emplace_back(rows, 0, -1.0);
    entries.emplace_back(rows++, k * k - 1 - (k * k - 1) % 3, 2.0);
    B.resize(rows, K.cols());
    B.setFromTriplets(entries.begin(), entries.end());
    contact = slant::contact::touched_unknowns(B);
  }
  [[nodiscard]] Eigen::MatrixXd dual() const {
    return B * solutions_of(Eigen::MatrixXd(K), Eigen::MatrixXd(B.transpose()));
  }
};

}  // namespace test
