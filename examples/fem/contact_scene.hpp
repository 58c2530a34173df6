// SPDX-License-Identifier: MIT
//
// A discretised contact problem with Tresca friction [K (14)–(21), T (4.2)]:
//
//   min ½ uᵀK u − fᵀu + Σ gᵢ ‖(T u)ᵢ‖   subject to   N u ≤ d
//
// and the map back from its unknowns to the mesh.
#pragma once

#include <Eigen/SparseCore>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include <fem/box_mesh.hpp>
#include <fem/elasticity.hpp>
#include <fem/surface.hpp>
#include <fem/unknowns.hpp>

namespace fem {

/// Data of the contact problem. D − 1 tangential rows per contact node: in space rows 2i and 2i+1
/// of T belong to node i.
template <int D>
struct contact_scene {
  Eigen::SparseMatrix<double> K;      ///< stiffness, n_u × n_u, both triangles
  Eigen::SparseMatrix<double> N;      ///< normal displacement towards the obstacle, m × n_u
  Eigen::SparseMatrix<double> T;      ///< tangential displacement, (D−1) m × n_u
  Eigen::VectorXd f;                  ///< load, n_u
  Eigen::VectorXd d;                  ///< initial gap of each contact node, m
  Eigen::VectorXd g;                  ///< slip bound of each contact node as a force, m
  simplex_mesh<D> mesh;               ///< all bodies
  unknown_map unknowns;               ///< node → unknowns
  std::vector<int> contact_nodes;     ///< mesh node of each contact node, m; of the first body
  std::vector<int> opposite_nodes{};  ///< that of the second body, m; none on a foundation
  surface_patch<D> contact_side;      ///< the whole side, fixed nodes included
  std::vector<surface_patch<D>> contact_patches;  ///< part of the contact side of each of them, m
  Eigen::VectorXd contact_weights;                ///< ωᵢ, area of the patches, m

  [[nodiscard]] Eigen::Index contact_count() const { return d.size(); }

  /// Displacement of every mesh node, one column each.
  [[nodiscard]] Eigen::Matrix<double, D, Eigen::Dynamic> displacement(
      Eigen::VectorXd const& u) const {
    return nodal_displacement<D>(unknowns, u);
  }
};

/// A traction (force per area) on one side, p(x) = traction + gradient x; constant without
/// gradient.
template <int D>
struct side_traction {
  box_side side;
  Eigen::Matrix<double, D, 1> traction;
  std::optional<Eigen::Matrix<double, D, D>> gradient{};
};

/// Adds the consistent load of all tractions to f.
template <int D>
void add_tractions(box_mesh<D> const& mesh, unknown_map const& unknowns,
                   std::vector<side_traction<D>> const& loads, Eigen::VectorXd& f) {
  for (auto const& load : loads) {
    if (!load.gradient) {
      add_traction(mesh, unknowns, load.side, load.traction, f);
      continue;
    }
    auto const p = [&](Eigen::Matrix<double, D, 1> const& x) {
      return Eigen::Matrix<double, D, 1>(load.traction + *load.gradient * x);
    };
    add_affine_traction<D>(mesh, unknowns, load.side, p, f);
  }
}

/// What stands on the foundation and what acts on it.
template <int D>
struct box_on_foundation {
  box_mesh<D> mesh;
  lame_parameters material;
  box_side fixed;    ///< zero displacement
  box_side contact;  ///< may touch the rigid foundation
  std::vector<side_traction<D>> loads{};
  double slip_bound = 0;  ///< g of Tresca's law, force per area
  double gap = 0;         ///< distance of the contact side from the foundation
};

/// Discretises a box that touches a rigid foundation. Contact nodes are the nodes of the contact
/// side that are not fixed; gᵢ = ωᵢ g with trapezoidal weights; the tangential directions are the
/// other axes in their order. Throws std::invalid_argument for a negative or infinite slip bound or
/// a gap < 0.
template <int D>
[[nodiscard]] contact_scene<D> make_contact_scene(box_on_foundation<D> const& box) {
  require(box.slip_bound >= 0 && std::isfinite(box.slip_bound), "slip_bound", box.slip_bound,
          "a finite number >= 0");
  require(box.gap >= 0 && std::isfinite(box.gap), "gap", box.gap, "a finite number >= 0");
  require(box.fixed.axis != box.contact.axis || box.fixed.upper != box.contact.upper, "contact",
          box.contact.axis, "another side than the fixed one");

  contact_scene<D> scene;
  scene.mesh = box.mesh;
  scene.unknowns =
      number_unknowns(box.mesh, [&](Eigen::Index node) { return box.mesh.on(box.fixed, node); });
  scene.K = stiffness<D>(box.mesh, scene.unknowns, box.material);
  scene.f = Eigen::VectorXd::Zero(scene.unknowns.count);
  add_tractions(box.mesh, scene.unknowns, box.loads, scene.f);

  auto const side_nodes = box.mesh.nodes_on(box.contact);
  for (int node : side_nodes)
    if (!scene.unknowns.is_fixed(node)) scene.contact_nodes.push_back(node);
  auto const m = static_cast<Eigen::Index>(scene.contact_nodes.size());

  scene.contact_side.lower = patch_of<D>(box.mesh, box.contact, side_nodes.front()).lower;
  scene.contact_side.upper = patch_of<D>(box.mesh, box.contact, side_nodes.back()).upper;
  scene.contact_side.centre = (scene.contact_side.lower + scene.contact_side.upper) / 2;

  double const outwards = box.contact.upper ? 1 : -1;
  scene.contact_weights.resize(m);
  scene.N.resize(m, scene.unknowns.count);
  scene.T.resize((D - 1) * m, scene.unknowns.count);
  for (Eigen::Index i = 0; i < m; ++i) {
    int const node = scene.contact_nodes[static_cast<std::size_t>(i)];
    scene.contact_patches.push_back(patch_of<D>(box.mesh, box.contact, node));
    scene.contact_weights[i] = scene.contact_patches.back().measure();
    int const first = scene.unknowns.first[node];
    scene.N.insert(i, first + box.contact.axis) = outwards;
    Eigen::Index row = (D - 1) * i;
    for (int axis = 0; axis < D; ++axis)
      if (axis != box.contact.axis) scene.T.insert(row++, first + axis) = 1;
  }
  scene.N.makeCompressed();
  scene.T.makeCompressed();
  scene.d = Eigen::VectorXd::Constant(m, box.gap);
  scene.g = box.slip_bound * scene.contact_weights;
  return scene;
}

}  // namespace fem
