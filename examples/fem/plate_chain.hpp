// SPDX-License-Identifier: MIT
//
// A chain of elastic plates beside each other, Ω_j = (j (1 + gap), …) × (0, 1), in plane stress,
// all fixed at their lower sides and loaded from above. The first one is pushed sideways. Only
// between the first few is there a chance of contact; the others touch nothing, and their
// equilibrium is a matter of one linear system each.
#pragma once

#include <Eigen/SparseCore>
#include <cmath>
#include <limits>
#include <vector>

#include <fem/contact_scene.hpp>
#include <fem/require.hpp>
#include <fem/two_bodies.hpp>

namespace fem {

/// What can be varied about the chain.
struct chain_options {
  int plates = 10;
  int touching = 2;  ///< the first so many may touch their neighbours
  int k = 6;         ///< k × k cells for each plate
  double gap = 1e-3;
};

/// min ½ uᵀK u − fᵀu over B u ≤ c; c is +infinity between plates that cannot touch.
struct chain_scene {
  Eigen::SparseMatrix<double> K;
  Eigen::VectorXd f;
  Eigen::SparseMatrix<double> B;
  Eigen::VectorXd c;
};

/// Assembles the chain. Throws std::invalid_argument for numbers out of range.
[[nodiscard]] inline chain_scene make_plate_chain(chain_options const& options) {
  require(options.plates >= 1, "plates", options.plates, "at least one plate");
  require(options.touching >= 0, "touching", options.touching, "a number >= 0");
  require(options.gap >= 0 && std::isfinite(options.gap), "gap", options.gap, "a number >= 0");
  require(options.touching <= options.plates, "touching", options.touching,
          "no more than there are plates");
  auto const mesh = make_box_mesh<2>({options.k, options.k}, {1, 1});
  auto const own = number_unknowns(mesh, [&](Eigen::Index node) {
    return mesh.on({1, false}, node);
  });
  auto const block = stiffness<2>(mesh, own, lame_plane_stress(100, 0.3));
  Eigen::VectorXd weight = Eigen::VectorXd::Zero(own.count);
  add_tractions<2>(mesh, own, {{{1, true}, {0, -1}}}, weight);
  Eigen::VectorXd push = Eigen::VectorXd::Zero(own.count);
  add_tractions<2>(mesh, own, {{{0, false}, {2, 0}}}, push);

  chain_scene scene;
  auto const per_plate = static_cast<int>(own.count);
  int const n = per_plate * options.plates;
  scene.K.resize(n, n);
  scene.K.reserve(block.nonZeros() * options.plates);
  scene.f.resize(n);
  for (int j = 0; j < options.plates; ++j) {
    detail::append_diagonal_block(block, per_plate * j, scene.K);
    scene.f.segment(per_plate * j, per_plate) = weight;
  }
  scene.K.finalize();
  scene.f.head(per_plate) += push;

  auto const right = mesh.nodes_on({0, true});
  auto const left = mesh.nodes_on({0, false});
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<double> gaps;
  for (int j = 0; j + 1 < options.plates; ++j) {
    for (std::size_t i = 0; i < right.size(); ++i) {
      if (own.is_fixed(right[i])) continue;
      auto const row = static_cast<int>(gaps.size());
      entries.emplace_back(row, per_plate * j + own.first[right[i]], 1);
      entries.emplace_back(row, per_plate * (j + 1) + own.first[left[i]], -1);
      gaps.push_back(j + 1 < options.touching ? options.gap
                                              : std::numeric_limits<double>::infinity());
    }
  }
  scene.B.resize(static_cast<Eigen::Index>(gaps.size()), n);
  scene.B.setFromTriplets(entries.begin(), entries.end());
  scene.c = Eigen::Map<Eigen::VectorXd>(gaps.data(), static_cast<Eigen::Index>(gaps.size()));
  return scene;
}

}  // namespace fem
