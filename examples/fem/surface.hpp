// SPDX-License-Identifier: MIT
//
// Integrals over a side of a box: loads by surface tractions and the weights of the contact nodes.
#pragma once

#include <Eigen/Core>

#include <fem/box_mesh.hpp>
#include <fem/unknowns.hpp>

namespace fem {

/// Length (D = 2) or area (D = 3) of the facet of a simplex opposite to vertex a: since the height
/// over it is 1/‖g_a‖ with g_a the gradient of the hat function, it is D · volume · ‖g_a‖.
template <int D>
[[nodiscard]] double facet_measure(p1_element<D> const& element, int a) {
  return D * element.volume * element.gradients.col(a).norm();
}

/// Adds to f the consistent P1 load of a traction p(x) (force per area), constant or affine in x,
/// on a side of the box: vertex a of a facet takes ∫φ_a p, which is the D-th part of the facet's
/// measure times p at the centre of gravity of the hat function φ_a; exact for affine p.
template <int D, class Traction>
void add_affine_traction(box_mesh<D> const& mesh, unknown_map const& unknowns, box_side side,
                         Traction const& p, Eigen::VectorXd& f) {
  using point = Eigen::Matrix<double, D, 1>;
  for (Eigen::Index cell = 0; cell < mesh.cell_count(); ++cell) {
    int opposite = -1;
    int count = 0;
    point sum = point::Zero();
    for (int a = 0; a <= D; ++a) {
      int const node = mesh.cells(a, cell);
      if (mesh.on(side, node)) {
        ++count;
        sum += mesh.nodes.col(node);
      } else {
        opposite = a;
      }
    }
    if (count != D) continue;
    double const share = facet_measure(element_of<D>(mesh, cell), opposite) / D;
    for (int a = 0; a <= D; ++a) {
      int const node = mesh.cells(a, cell);
      if (a == opposite || unknowns.is_fixed(node)) continue;
      point const centre = (sum + mesh.nodes.col(node)) / (D + 1);
      f.template segment<D>(unknowns.first[node]) += share * p(centre);
    }
  }
}

/// The same for a constant traction.
template <int D>
void add_traction(box_mesh<D> const& mesh, unknown_map const& unknowns, box_side side,
                  Eigen::Matrix<double, D, 1> const& traction, Eigen::VectorXd& f) {
  add_affine_traction<D>(
      mesh, unknowns, side, [&](auto const&) { return traction; }, f);
}

/// The part of a plane side that is nearer to a node than to any other: a box in the D − 1
/// coordinates of the side, which are the other axes in their order.
template <int D>
struct surface_patch {
  Eigen::Matrix<double, D - 1, 1> centre;  ///< the node
  Eigen::Matrix<double, D - 1, 1> lower;
  Eigen::Matrix<double, D - 1, 1> upper;

  /// Area (length for D = 2): the weight of the node in the trapezoidal rule. The weights of all
  /// nodes of a side sum to its area.
  [[nodiscard]] double measure() const { return (upper - lower).prod(); }
};

/// The patch of a node of a side.
template <int D>
[[nodiscard]] surface_patch<D> patch_of(box_mesh<D> const& mesh, box_side side, Eigen::Index node) {
  auto const at = mesh.lattice(node);
  surface_patch<D> patch;
  for (int axis = 0, t = 0; axis < D; ++axis) {
    if (axis == side.axis) continue;
    int const i = at[static_cast<std::size_t>(axis)];
    int const n = mesh.cells_along[static_cast<std::size_t>(axis)];
    double const spacing = mesh.size[axis] / n;
    patch.centre[t] = mesh.nodes(axis, node);
    patch.lower[t] = patch.centre[t] - (i == 0 ? 0 : spacing / 2);
    patch.upper[t] = patch.centre[t] + (i == n ? 0 : spacing / 2);
    ++t;
  }
  return patch;
}

}  // namespace fem
