// SPDX-License-Identifier: MIT
//
// A trailing part of a supernodal factor, made by hand, with the dense matrix that it means.
#pragma once

#include <slant/factorizations/parts/tail.hpp>

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace test {

/// Supernodes of 3, 8, 21 and 12 columns, the first two with some rows below, the third with all.
struct tail_factor {
  std::shared_ptr<slant::detail::tail_shape> shape = std::make_shared<slant::detail::tail_shape>();
  std::shared_ptr<std::vector<Eigen::MatrixXd>> blocks =
      std::make_shared<std::vector<Eigen::MatrixXd>>();
  Eigen::MatrixXd L;

  tail_factor() {
    std::vector<int> rest;
    for (int i = 32; i < 44; ++i) rest.push_back(i);
    add(3, {4, 9, 12, 31, 40});
    add(8, {12, 33});
    add(21, rest);
    add(12, {});
    L = Eigen::MatrixXd::Zero(shape->size(), shape->size());
    auto block = blocks->begin();
    for (auto const& s : shape->supernodes()) {
      for (slant::index j = 0; j < s.columns; ++j) {
        for (slant::index i = j; i < s.columns; ++i) L(s.first + i, s.first + j) = (*block)(i, j);
        for (slant::index i = 0; i < s.below; ++i)
          L(shape->rows(s)[i], s.first + j) = (*block)(s.columns + i, j);
      }
      ++block;
    }
  }
  void add(slant::index columns, std::vector<int> const& below) {
    shape->add(columns, below);
    // What stands above the diagonal is not part of the factor.
    Eigen::MatrixXd block =
        Eigen::MatrixXd::Random(columns + slant::index(below.size()), columns) / 8;
    block.diagonal().array() += 1;
    blocks->push_back(block);
  }
  [[nodiscard]] slant::detail::tail_columns columns() const {
    std::vector<slant::detail::tail_columns::matrix> matrices;
    for (auto const& block : *blocks) matrices.push_back({block.data(), block.rows()});
    return {shape, matrices, blocks};
  }
  /// (L Lᵀ)⁻¹ b.
  [[nodiscard]] Eigen::MatrixXd solved(Eigen::MatrixXd const& b) const {
    return L.transpose().triangularView<Eigen::Upper>().solve(
        L.triangularView<Eigen::Lower>().solve(b));
  }
};

}  // namespace test
