// SPDX-License-Identifier: MIT
//
// What most programs use of the element library, in the plane and in space: compiled once, in
// instances.cpp, for what is linked with it.
#pragma once

#include <fem/box_mesh.hpp>
#include <fem/box_prolongations.hpp>
#include <fem/contact_scene.hpp>
#include <fem/elasticity.hpp>
#include <fem/two_bodies.hpp>

#if !defined(FEM_INSTANCE)
#define FEM_INSTANCE extern template
#endif

namespace fem {

#define FEM_INSTANCES(D)                                                                         \
  FEM_INSTANCE box_mesh<D> make_box_mesh<D>(std::array<int, D> const&,                           \
                                            Eigen::Matrix<double, D, 1> const&,                  \
                                            Eigen::Matrix<double, D, 1> const&);                 \
  FEM_INSTANCE Eigen::SparseMatrix<double> stiffness<D>(                                         \
      simplex_mesh<D> const&, unknown_map const&, lame_parameters const&);                       \
  FEM_INSTANCE void add_tractions<D>(box_mesh<D> const&, unknown_map const&,                     \
                                     std::vector<side_traction<D>> const&, Eigen::VectorXd&);    \
  FEM_INSTANCE contact_scene<D> make_contact_scene<D>(box_on_foundation<D> const&);              \
  FEM_INSTANCE contact_scene<D> make_two_body_scene<D>(boxes_in_contact<D> const&);              \
  FEM_INSTANCE std::vector<Eigen::SparseMatrix<double>> box_prolongations<D>(box_mesh<D> const&, \
                                                                             unknown_map const&)
FEM_INSTANCES(2);
FEM_INSTANCES(3);
#undef FEM_INSTANCES

}  // namespace fem
