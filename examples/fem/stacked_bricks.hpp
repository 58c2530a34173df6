// SPDX-License-Identifier: MIT
//
// A stack of elastic bricks in a corner: Ω_j = (0, a) × (0, b) × (j h, (j+1) h), one on top of the
// other. Nothing is fixed. Each brick may touch its neighbours, the lowest one the floor z = 0, and
// all of them the walls x = 0 and y = 0, without friction: held by contact alone, K = diag(K₀, K₁,
// …) has six rigid motions for each brick.
//
// Loads: pressures towards the walls and on top, which hold the stack; the one on top changes with
// x, so that contact opens. Or the top is pulled up: then there is no equilibrium.
#pragma once

#include <Eigen/SparseCore>
#include <array>
#include <vector>

#include <fem/contact_scene.hpp>
#include <fem/two_bodies.hpp>

namespace fem {

/// What can be varied about the stack.
struct stack_options {
  int bricks = 2;
  std::array<int, 3> cells{4, 2, 2};  ///< of each brick
  Eigen::Vector3d size{2, 1, 1};      ///< of each brick
  std::vector<double> E{2.1e5};       ///< MPa, of brick j: E[j mod size]
  double nu = 0.3;
  double walls = 0.3;              ///< pressure towards the walls on the sides opposite
  Eigen::Vector2d top{1.5, -0.4};  ///< pressure on top at x = 0 and at x = a
  double gap = 0;                  ///< between neighbours and to the floor
};

/// min ½ uᵀK u − fᵀu over B u ≤ c. All rows of B have at most two entries ±1.
struct stack_scene {
  Eigen::SparseMatrix<double> K;
  Eigen::VectorXd f;
  Eigen::SparseMatrix<double> B;
  Eigen::VectorXd c;
  simplex_mesh<3> mesh;    ///< all bricks
  unknown_map unknowns;    ///< node → unknowns
  std::vector<int> nodes;  ///< the node of each row of B; of two bodies, that of the upper one
  std::vector<int> axes;   ///< the direction of each row of B
};

/// Assembles the stack. Throws std::invalid_argument for numbers out of range.
[[nodiscard]] inline stack_scene make_stack(stack_options const& options) {
  require(options.bricks >= 1, "bricks", options.bricks, "at least one brick");
  require(!options.E.empty(), "E", options.E.size(), "one Young modulus at least");
  require(options.gap >= 0 && std::isfinite(options.gap), "gap", options.gap, "a number >= 0");
  double const height = options.size[2];
  std::vector<box_mesh<3>> meshes;
  std::vector<Eigen::SparseMatrix<double>> blocks;
  std::vector<Eigen::VectorXd> loads;
  for (int j = 0; j < options.bricks; ++j) {
    double const z = options.gap + j * (height + options.gap);
    meshes.push_back(make_box_mesh<3>(options.cells, options.size, {0, 0, z}));
    auto const& mesh = meshes.back();
    auto const own = number_unknowns(mesh, [](Eigen::Index) { return false; });
    auto const E = options.E[static_cast<std::size_t>(j) % options.E.size()];
    blocks.push_back(stiffness<3>(mesh, own, lame(E, options.nu)));
    std::vector<side_traction<3>> tractions{{{0, true}, {-options.walls, 0, 0}},
                                            {{1, true}, {0, -options.walls, 0}}};
    if (j + 1 == options.bricks) {
      Eigen::Matrix3d slope = Eigen::Matrix3d::Zero();
      slope(2, 0) = (options.top[0] - options.top[1]) / options.size[0];
      tractions.push_back({{2, true}, {0, 0, -options.top[0]}, slope});
    }
    loads.push_back(Eigen::VectorXd::Zero(own.count));
    add_tractions(mesh, own, tractions, loads.back());
  }

  stack_scene scene;
  Eigen::Index const per_brick = meshes.front().node_count();
  Eigen::Index const n = 3 * per_brick * options.bricks;
  scene.unknowns.count = n;
  scene.unknowns.first =
      Eigen::VectorXi::LinSpaced(per_brick * options.bricks, 0, static_cast<int>(n) - 3);
  scene.K.resize(n, n);
  scene.K.reserve(blocks.front().nonZeros() * options.bricks);
  scene.f.resize(n);
  Eigen::Index const cells = meshes.front().cell_count();
  scene.mesh.nodes.resize(3, per_brick * options.bricks);
  scene.mesh.cells.resize(4, cells * options.bricks);
  for (int j = 0; j < options.bricks; ++j) {
    auto const at = static_cast<std::size_t>(j);
    detail::append_diagonal_block(blocks[at], static_cast<int>(3 * per_brick) * j, scene.K);
    scene.f.segment(3 * per_brick * j, 3 * per_brick) = loads[at];
    scene.mesh.nodes.middleCols(per_brick * j, per_brick) = meshes[at].nodes;
    scene.mesh.cells.middleCols(cells * j, cells) =
        (meshes[at].cells.array() + static_cast<int>(per_brick) * j).matrix();
  }
  scene.K.finalize();

  std::vector<Eigen::Triplet<double>> entries;
  std::vector<double> gaps;
  auto const add = [&](int node, int axis, int opposite, double gap) {
    auto const row = static_cast<int>(gaps.size());
    entries.emplace_back(row, 3 * node + axis, -1);
    if (opposite >= 0) entries.emplace_back(row, 3 * opposite + axis, 1);
    gaps.push_back(gap);
    scene.nodes.push_back(node);
    scene.axes.push_back(axis);
  };
  for (int j = 0; j < options.bricks; ++j) {
    auto const& mesh = meshes[static_cast<std::size_t>(j)];
    auto const first = static_cast<int>(per_brick) * j;
    auto const below = mesh.nodes_on({2, false});
    auto const above = mesh.nodes_on({2, true});
    for (std::size_t i = 0; i < below.size(); ++i) {
      int const opposite = j > 0 ? first - static_cast<int>(per_brick) + above[i] : -1;
      add(first + below[i], 2, opposite, options.gap);
    }
    for (int axis = 0; axis < 2; ++axis) {
      for (int const node : mesh.nodes_on({axis, false})) add(first + node, axis, -1, 0);
    }
  }
  scene.B.resize(static_cast<Eigen::Index>(gaps.size()), n);
  scene.B.setFromTriplets(entries.begin(), entries.end());
  scene.c = Eigen::Map<Eigen::VectorXd>(gaps.data(), static_cast<Eigen::Index>(gaps.size()));
  return scene;
}

}  // namespace fem
