// SPDX-License-Identifier: MIT
//
// From a coarse grid of a rectangle to a fine one: bilinear interpolation of values that are zero
// on the edges. The nodes of the two grids need not have any place in common, and the bounds of one
// need not hold on the other: methods project their start.
#pragma once

#include <Eigen/SparseCore>
#include <array>
#include <utility>
#include <vector>

#include <fem/interpolation.hpp>
#include <fem/rectangle_grid.hpp>

namespace fem {

/// The matrix of the prolongation, fine.size() × coarse.size(); as an operator
/// slant::matrix(grid_prolongation(coarse, fine)), whose adjoint restricts loads. Throws
/// std::invalid_argument unless both are grids of the same rectangle.
template <class S>
[[nodiscard]] Eigen::SparseMatrix<S> grid_prolongation(rectangle_grid<S> const& coarse,
                                                       rectangle_grid<S> const& fine) {
  require_grid(coarse);
  require_grid(fine);
  require(coarse.width == fine.width, "width", fine.width, "that of the coarse grid");
  require(coarse.height == fine.height, "height", fine.height, "that of the coarse grid");
  auto const in_x = interpolate(coarse.all_x(), fine.all_x());
  auto const in_y = interpolate(coarse.all_y(), fine.all_y());

  // Place p of a line with its ends on the edges is interior node p − 1.
  auto const neighbours = [](interpolated<S> const& at) {
    return std::array{std::pair{static_cast<Eigen::Index>(at.left) - 1, S(S(1) - at.weight)},
                      std::pair{static_cast<Eigen::Index>(at.right) - 1, at.weight}};
  };
  std::vector<Eigen::Triplet<S>> entries;
  entries.reserve(static_cast<std::size_t>(4 * fine.size()));
  for (Eigen::Index j = 0; j < fine.ny; ++j)
    for (Eigen::Index i = 0; i < fine.nx; ++i)
      for (auto const& [l, v] : neighbours(in_y[static_cast<std::size_t>(j + 1)]))
        for (auto const& [k, u] : neighbours(in_x[static_cast<std::size_t>(i + 1)])) {
          bool const interior = k >= 0 && k < coarse.nx && l >= 0 && l < coarse.ny;
          if (!interior || u * v == S(0)) continue;
          entries.emplace_back(static_cast<int>(fine.unknown(i, j)),
                               static_cast<int>(coarse.unknown(k, l)), S(u * v));
        }
  Eigen::SparseMatrix<S> P(fine.size(), coarse.size());
  P.setFromTriplets(entries.begin(), entries.end());
  return P;
}

}  // namespace fem
