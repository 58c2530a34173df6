// SPDX-License-Identifier: MIT
//
// A body that no support holds.
#pragma once

#include <slant/contact/contact_data.hpp>

#include <Eigen/SparseCore>

#include <cstddef>
#include <fem/stacked_bricks.hpp>

namespace test {

/// The steel brick (0,3) × (0,1) × (0,1) without its clamp, on the floor z = 0.
struct loose_brick {
  fem::box_mesh<3> mesh = fem::make_box_mesh<3>({3, 2, 2}, {3, 1, 1});
  fem::unknown_map unknowns = fem::number_unknowns(mesh, [](Eigen::Index) { return false; });
  Eigen::SparseMatrix<double> K = fem::stiffness<3>(mesh, unknowns, fem::lame(2.119e5, 0.277));
  slant::contact::data<double> data{};

  /// Pressure on top, a traction on the right end, a slip bound as force per node.
  loose_brick(double press, Eigen::Vector3d const& end, double slip, bool friction = true) {
    auto const nodes = mesh.nodes_on({2, false});
    auto const m = static_cast<Eigen::Index>(nodes.size());
    data.f = Eigen::VectorXd::Zero(K.rows());
    fem::add_tractions<3>(mesh, unknowns, {{{2, true}, {0, 0, -press}}, {{0, true}, end}}, data.f);
    data.N.resize(m, K.rows());
    data.T.resize(friction ? 2 * m : 0, K.rows());
    for (Eigen::Index i = 0; i < m; ++i) {
      int const first = unknowns.first[nodes[static_cast<std::size_t>(i)]];
      data.N.insert(i, first + 2) = -1;
      if (!friction) continue;
      data.T.insert(2 * i, first) = 1;
      data.T.insert(2 * i + 1, first + 1) = 1;
    }
    data.d = Eigen::VectorXd::Zero(m);
    if (friction) data.g = Eigen::VectorXd::Constant(m, slip);
  }
};

}  // namespace test
