// SPDX-License-Identifier: MIT
//
// Prolongations of a box mesh with even numbers of cells, for multigrid: interpolation from the mesh
// of cells twice as long, linear along each axis, from up to eight corners. Rejected: linear
// interpolation on its simplices, whose unions they are, from up to two corners: a third to a half
// more steps of conjugate gradients.
#pragma once

#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include <fem/box_mesh.hpp>
#include <fem/unknowns.hpp>

namespace fem {

/// Weights of nodes with unknowns, one matrix from each mesh to the next finer one, the finest
/// first: as many as the cells can be halved.
template <int D>
[[nodiscard]] std::vector<Eigen::SparseMatrix<double>> box_prolongations(
    box_mesh<D> const& mesh, unknown_map const& unknowns) {
  constexpr auto dimension = static_cast<std::size_t>(D);
  using lattice = std::array<int, dimension>;
  auto cells = mesh.cells_along;
  auto const number_in = [](lattice const& at, lattice const& along) {
    std::size_t number = 0;
    for (std::size_t a = 0; a < dimension; ++a) {
      number = number * static_cast<std::size_t>(along[a] + 1) + static_cast<std::size_t>(at[a]);
    }
    return number;
  };
  // Free nodes of the mesh at hand, and the numbers of all its nodes among them, or −1.
  std::vector<lattice> free;
  for (Eigen::Index node = 0; node < mesh.node_count(); ++node) {
    if (!unknowns.is_fixed(node)) free.push_back(mesh.lattice(node));
  }
  std::vector<Eigen::SparseMatrix<double>> all;
  while (std::all_of(cells.begin(), cells.end(), [](int n) { return n % 2 == 0; })) {
    for (int& n : cells) n /= 2;
    std::vector<lattice> coarse;
    lattice last = cells;
    std::vector<int> number(number_in(last, cells) + 1, -1);
    for (lattice at : free) {
      if (!std::all_of(at.begin(), at.end(), [](int i) { return i % 2 == 0; })) continue;
      for (int& i : at) i /= 2;
      number[number_in(at, cells)] = static_cast<int>(coarse.size());
      coarse.push_back(at);
    }
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t i = 0; i < free.size(); ++i) {
      for (std::size_t corner = 0; corner < (std::size_t{1} << dimension); ++corner) {
        lattice at{};
        for (std::size_t a = 0; a < dimension; ++a) {
          at[a] = (free[i][a] + static_cast<int>(corner >> a & 1)) / 2;
        }
        int const j = number[number_in(at, cells)];
        if (j >= 0) entries.emplace_back(static_cast<int>(i), j, 1.0 / (1 << dimension));
      }
    }
    Eigen::SparseMatrix<double> P(static_cast<Eigen::Index>(free.size()),
                                  static_cast<Eigen::Index>(coarse.size()));
    P.setFromTriplets(entries.begin(), entries.end());
    all.push_back(std::move(P));
    free = std::move(coarse);
  }
  return all;
}

}  // namespace fem
