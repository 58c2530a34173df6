// SPDX-License-Identifier: MIT
//
// From a coarse mesh of the wire to a fine one: linear interpolation of both components, which are
// zero at the fixed ends. The nodes of two meshes need not have any place in common, and the half
// lines and discs of one need not hold on the other: methods project their start.
#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include <fem/interpolation.hpp>
#include <fem/string_1d.hpp>

namespace fem {

/// The matrix 4m × 4m' of the prolongation from a wire with m' bounds to one with m; as an operator
/// slant::matrix(wire_prolongation(coarse, fine)), whose adjoint restricts loads.
template <class S>
[[nodiscard]] Eigen::SparseMatrix<S> wire_prolongation(wire<S> const& coarse, wire<S> const& fine) {
  // Points 0 and 2m'+1 are the fixed ends, where the value is zero and no unknown.
  std::vector<S> from{S(0)};
  for (Eigen::Index node = 0; node < 2 * coarse.m; ++node) from.push_back(coarse.t(node));
  from.push_back(S(1));
  std::vector<S> to;
  for (Eigen::Index node = 0; node < 2 * fine.m; ++node) to.push_back(fine.t(node));

  auto const places = interpolate(from, to);
  std::vector<Eigen::Triplet<S>> entries;
  for (Eigen::Index node = 0; node < 2 * fine.m; ++node) {
    auto const& [left, right, weight] = places[static_cast<std::size_t>(node)];
    auto const add = [&, row = node](std::size_t point, S const& value) {
      auto const source = static_cast<Eigen::Index>(point) - 1;
      if (source < 0 || source >= 2 * coarse.m || value == S(0)) return;
      for (int component = 0; component < 2; ++component)
        entries.emplace_back(static_cast<int>(fine.unknown(row, component)),
                             static_cast<int>(coarse.unknown(source, component)), value);
    };
    add(left, S(1) - weight);
    add(right, weight);
  }
  Eigen::SparseMatrix<S> P(4 * fine.m, 4 * coarse.m);
  P.setFromTriplets(entries.begin(), entries.end());
  return P;
}

}  // namespace fem
