// SPDX-License-Identifier: MIT
//
// Two elastic boxes in contact with Tresca friction [K (14)–(21), Ex 5, Ex 6]. Both contact sides
// carry the same grid, so each contact node is a pair of nodes, and with n the outer normal of the
// first body
//
//     (N u)ᵢ = n·(u¹ − u²) ≤ dᵢ,    (T u)ᵢ = tangential part of u¹ − u²,    K = diag(K¹, K²):
//
// N = [n, −n] on matching nodes; the same multiplier pushes both bodies, in opposite directions.
#pragma once

#include <cmath>
#include <vector>

#include <fem/contact_scene.hpp>

namespace fem {

/// One of the bodies. Its fixed side makes its stiffness definite.
template <int D>
struct loaded_box {
  box_mesh<D> mesh;
  lame_parameters material;
  box_side fixed;  ///< zero displacement
  std::vector<side_traction<D>> loads{};
};

/// Two boxes; `contact` of the first may touch the opposite side of the second.
template <int D>
struct boxes_in_contact {
  loaded_box<D> first;
  loaded_box<D> second;
  box_side contact;
  double slip_bound = 0;  ///< g of Tresca's law, force per area
};

namespace detail {

/// Copies a square matrix to the diagonal of a larger one, behind what was filled in before.
inline void append_diagonal_block(Eigen::SparseMatrix<double> const& block, int first,
                                  Eigen::SparseMatrix<double>& matrix) {
  for (Eigen::Index j = 0; j < block.outerSize(); ++j) {
    matrix.startVec(first + j);
    for (Eigen::SparseMatrix<double>::InnerIterator e(block, j); e; ++e)
      matrix.insertBack(first + e.row(), first + j) = e.value();
  }
}

/// Mesh, unknowns, stiffness and load of both bodies; the second stands behind the first.
template <int D>
void assemble_bodies(boxes_in_contact<D> const& pair, contact_scene<D>& scene) {
  auto const number = [](loaded_box<D> const& box) {
    return number_unknowns(box.mesh,
                           [&](Eigen::Index node) { return box.mesh.on(box.fixed, node); });
  };
  unknown_map const one = number(pair.first);
  unknown_map const two = number(pair.second);
  Eigen::Index const nodes = pair.first.mesh.node_count();
  Eigen::Index const cells = pair.first.mesh.cell_count();

  scene.mesh.nodes.resize(D, nodes + pair.second.mesh.node_count());
  scene.mesh.nodes << pair.first.mesh.nodes, pair.second.mesh.nodes;
  scene.mesh.cells.resize(D + 1, cells + pair.second.mesh.cell_count());
  scene.mesh.cells << pair.first.mesh.cells,
      (pair.second.mesh.cells.array() + static_cast<int>(nodes)).matrix();

  scene.unknowns.count = one.count + two.count;
  scene.unknowns.first.resize(scene.mesh.node_count());
  scene.unknowns.first.head(nodes) = one.first;
  for (Eigen::Index node = 0; node < two.first.size(); ++node)
    scene.unknowns.first[nodes + node] =
        two.is_fixed(node) ? -1 : two.first[node] + static_cast<int>(one.count);

  auto const K1 = stiffness<D>(pair.first.mesh, one, pair.first.material);
  auto const K2 = stiffness<D>(pair.second.mesh, two, pair.second.material);
  scene.K.resize(scene.unknowns.count, scene.unknowns.count);
  scene.K.reserve(K1.nonZeros() + K2.nonZeros());
  append_diagonal_block(K1, 0, scene.K);
  append_diagonal_block(K2, static_cast<int>(one.count), scene.K);
  scene.K.finalize();

  Eigen::VectorXd f1 = Eigen::VectorXd::Zero(one.count);
  Eigen::VectorXd f2 = Eigen::VectorXd::Zero(two.count);
  add_tractions(pair.first.mesh, one, pair.first.loads, f1);
  add_tractions(pair.second.mesh, two, pair.second.loads, f2);
  scene.f.resize(scene.unknowns.count);
  scene.f << f1, f2;
}

/// The distance of the two contact sides. Throws std::invalid_argument unless they lie opposite
/// each other with the same grid and no overlap.
template <int D>
[[nodiscard]] double checked_gap(boxes_in_contact<D> const& pair) {
  auto const& one = pair.first.mesh;
  auto const& two = pair.second.mesh;
  for (int axis = 0; axis < D; ++axis) {
    if (axis == pair.contact.axis) continue;
    auto const a = static_cast<std::size_t>(axis);
    require(one.cells_along[a] == two.cells_along[a], "cells_along", two.cells_along[a],
            "the same grid on both contact sides");
    require(one.origin[axis] == two.origin[axis], "origin", two.origin[axis],
            "bodies that lie opposite each other");
    require(one.size[axis] == two.size[axis], "size", two.size[axis],
            "bodies that lie opposite each other");
  }
  int const axis = pair.contact.axis;
  double const gap = pair.contact.upper ? two.origin[axis] - (one.origin[axis] + one.size[axis])
                                        : one.origin[axis] - (two.origin[axis] + two.size[axis]);
  require(gap >= 0, "origin", two.origin[axis], "bodies that do not overlap");
  return gap;
}

}  // namespace detail

/// Discretises the two bodies. Contact nodes are the pairs of which a node is not fixed; gᵢ = ωᵢ g
/// with trapezoidal weights, as on a rigid foundation, so λᵢ and gᵢ are forces; dᵢ is the distance
/// of the sides. Throws std::invalid_argument for a negative or infinite slip bound, or for sides
/// whose grids do not match.
template <int D>
[[nodiscard]] contact_scene<D> make_two_body_scene(boxes_in_contact<D> const& pair) {
  require(pair.slip_bound >= 0 && std::isfinite(pair.slip_bound), "slip_bound", pair.slip_bound,
          "a finite number >= 0");
  double const gap = detail::checked_gap(pair);
  contact_scene<D> scene;
  detail::assemble_bodies(pair, scene);

  box_side const contact = pair.contact;
  auto const& mesh = pair.first.mesh;
  auto const one = mesh.nodes_on(contact);
  auto const two = pair.second.mesh.nodes_on({contact.axis, !contact.upper});
  auto const behind = static_cast<int>(mesh.node_count());
  scene.contact_side.lower = patch_of<D>(mesh, contact, one.front()).lower;
  scene.contact_side.upper = patch_of<D>(mesh, contact, one.back()).upper;
  scene.contact_side.centre = (scene.contact_side.lower + scene.contact_side.upper) / 2;
  for (std::size_t i = 0; i < one.size(); ++i) {
    if (scene.unknowns.is_fixed(one[i]) && scene.unknowns.is_fixed(behind + two[i])) continue;
    scene.contact_nodes.push_back(one[i]);
    scene.opposite_nodes.push_back(behind + two[i]);
    scene.contact_patches.push_back(patch_of<D>(mesh, contact, one[i]));
  }

  auto const m = static_cast<Eigen::Index>(scene.contact_nodes.size());
  double const outwards = contact.upper ? 1 : -1;
  scene.contact_weights.resize(m);
  scene.N.resize(m, scene.unknowns.count);
  scene.T.resize((D - 1) * m, scene.unknowns.count);
  auto const add = [&](Eigen::Index i, int node, double sign) {
    if (scene.unknowns.is_fixed(node)) return;
    int const first = scene.unknowns.first[node];
    scene.N.insert(i, first + contact.axis) = sign * outwards;
    Eigen::Index row = (D - 1) * i;
    for (int axis = 0; axis < D; ++axis)
      if (axis != contact.axis) scene.T.insert(row++, first + axis) = sign;
  };
  for (Eigen::Index i = 0; i < m; ++i) {
    auto const at = static_cast<std::size_t>(i);
    scene.contact_weights[i] = scene.contact_patches[at].measure();
    add(i, scene.contact_nodes[at], 1);
    add(i, scene.opposite_nodes[at], -1);
  }
  scene.N.makeCompressed();
  scene.T.makeCompressed();
  scene.d = Eigen::VectorXd::Constant(m, gap);
  scene.g = pair.slip_bound * scene.contact_weights;
  return scene;
}

}  // namespace fem
