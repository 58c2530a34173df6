// SPDX-License-Identifier: MIT
//
// A contact scene cut into subdomains that all float, for Total-FETI: every node has a copy in each
// subdomain that it belongs to, and
//
//     fixed nodes   B_E has a row for each component of each copy
//     other nodes   k copies u₁ … u_k are glued by k − 1 orthonormal rows a component,
//                   (u₁ + … + u_r − r u_{r+1}) / √(r (r + 1)),  r = 1 … k − 1
//
// so that B_E B_Eᵀ = I. Contact rows act on the mean of the copies, and loads are shared equally by
// them.
#pragma once

#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <fem/contact_scene.hpp>

namespace fem {

/// The parts of a decomposed contact scene. All unknowns: those of the subdomains, one after the
/// other, D for each of their nodes.
struct decomposed_scene {
  std::vector<Eigen::SparseMatrix<double>> K;  ///< stiffness of each subdomain
  std::vector<Eigen::MatrixXd> nodes;          ///< coordinates of its nodes, a column each
  Eigen::SparseMatrix<double> glue;            ///< B_E, Dirichlet conditions and gluing
  Eigen::SparseMatrix<double> mean;  ///< W: unknowns of the scene as means of their copies
  Eigen::SparseMatrix<double> N;     ///< N W
  Eigen::SparseMatrix<double> T;     ///< T W
  Eigen::VectorXd f;                 ///< Wᵀf

  /// Number of all unknowns.
  [[nodiscard]] Eigen::Index unknowns() const { return f.size(); }
};

/// The subdomain of each cell of a box that is cut into cuts[0] × cuts[1] × … boxes, as equal as
/// the cells allow. Throws std::invalid_argument unless each has a cell at least.
template <int D>
[[nodiscard]] std::vector<int> box_partition(box_mesh<D> const& mesh,
                                             std::array<int, D> const& cuts) {
  for (std::size_t axis = 0; axis < cuts.size(); ++axis)
    require(cuts[axis] >= 1 && cuts[axis] <= mesh.cells_along[axis], "cuts", cuts[axis],
            "at least one part and one cell for each");
  std::vector<int> part(static_cast<std::size_t>(mesh.cell_count()));
  for (Eigen::Index cell = 0; cell < mesh.cell_count(); ++cell) {
    int number = 0;
    for (std::size_t axis = 0; axis < cuts.size(); ++axis) {
      int lowest = mesh.cells_along[axis];
      for (int a = 0; a <= D; ++a)
        lowest = std::min(lowest, mesh.lattice(mesh.cells(a, cell))[axis]);
      number = number * cuts[axis] + lowest * cuts[axis] / mesh.cells_along[axis];
    }
    part[static_cast<std::size_t>(cell)] = number;
  }
  return part;
}

namespace detail {

/// Copies of a node: the first of the D unknowns of each.
using node_copies = std::vector<std::vector<int>>;

/// Mesh and stiffness of the cells of one subdomain, whose unknowns begin at `first`; registers the
/// copies of its nodes. Returns the number of its unknowns.
template <int D>
int append_subdomain(simplex_mesh<D> const& mesh, std::vector<Eigen::Index> const& cells,
                     lame_parameters const& material, int first, node_copies& copies,
                     decomposed_scene& scene) {
  std::vector<int> used;
  for (Eigen::Index const cell : cells)
    for (int a = 0; a <= D; ++a) used.push_back(mesh.cells(a, cell));
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());

  simplex_mesh<D> own;
  own.nodes.resize(D, static_cast<Eigen::Index>(used.size()));
  for (std::size_t i = 0; i < used.size(); ++i) {
    own.nodes.col(static_cast<Eigen::Index>(i)) = mesh.nodes.col(used[i]);
    copies[static_cast<std::size_t>(used[i])].push_back(first + D * static_cast<int>(i));
  }
  own.cells.resize(D + 1, static_cast<Eigen::Index>(cells.size()));
  for (std::size_t c = 0; c < cells.size(); ++c)
    for (int a = 0; a <= D; ++a)
      own.cells(a, static_cast<Eigen::Index>(c)) = static_cast<int>(
          std::lower_bound(used.begin(), used.end(), mesh.cells(a, cells[c])) - used.begin());
  auto const unknowns = number_unknowns(own, [](Eigen::Index) { return false; });
  scene.K.push_back(stiffness<D>(own, unknowns, material));
  scene.nodes.emplace_back(own.nodes);
  return static_cast<int>(unknowns.count);
}

}  // namespace detail

/// Cuts a scene of one body of one material. part[cell] is the subdomain of a cell, 0 … p − 1, and
/// each has cells that hang together by faces (else it has more motions than a rigid body). Throws
/// std::invalid_argument if there is not a number for each cell, or a subdomain without cells.
template <int D>
[[nodiscard]] decomposed_scene decompose(contact_scene<D> const& scene,
                                         lame_parameters const& material,
                                         std::vector<int> const& part) {
  require(static_cast<Eigen::Index>(part.size()) == scene.mesh.cell_count(), "part", part.size(),
          "a number for each cell");
  int const count = 1 + *std::max_element(part.begin(), part.end());
  std::vector<std::vector<Eigen::Index>> cells(static_cast<std::size_t>(count));
  for (std::size_t cell = 0; cell < part.size(); ++cell) {
    require(part[cell] >= 0, "part", part[cell], "numbers >= 0");
    cells[static_cast<std::size_t>(part[cell])].push_back(static_cast<Eigen::Index>(cell));
  }

  decomposed_scene result;
  detail::node_copies copies(static_cast<std::size_t>(scene.mesh.node_count()));
  int unknowns = 0;
  for (auto const& own : cells) {
    require(!own.empty(), "part", count, "a cell for each subdomain");
    unknowns += detail::append_subdomain<D>(scene.mesh, own, material, unknowns, copies, result);
  }

  std::vector<Eigen::Triplet<double>> glue, mean;
  int row = 0;
  for (Eigen::Index node = 0; node < scene.mesh.node_count(); ++node) {
    auto const& list = copies[static_cast<std::size_t>(node)];
    auto const k = static_cast<int>(list.size());
    for (int axis = 0; axis < D; ++axis) {
      if (scene.unknowns.is_fixed(node)) {
        for (int const first : list) glue.emplace_back(row++, first + axis, 1.0);
        continue;
      }
      for (int const first : list)
        mean.emplace_back(scene.unknowns.first[node] + axis, first + axis, 1.0 / k);
      for (int r = 1; r < k; ++r, ++row) {
        double const scale = 1 / std::sqrt(r * (r + 1.0));
        for (int i = 0; i < r; ++i)
          glue.emplace_back(row, list[static_cast<std::size_t>(i)] + axis, scale);
        glue.emplace_back(row, list[static_cast<std::size_t>(r)] + axis, -r * scale);
      }
    }
  }
  result.glue.resize(row, unknowns);
  result.glue.setFromTriplets(glue.begin(), glue.end());
  result.mean.resize(scene.unknowns.count, unknowns);
  result.mean.setFromTriplets(mean.begin(), mean.end());
  result.N = scene.N * result.mean;
  result.T = scene.T * result.mean;
  result.f = result.mean.transpose() * scene.f;
  return result;
}

}  // namespace fem
