// SPDX-License-Identifier: MIT
//
// Small contact scenes for the tests of this room.
#pragma once

#include <slant/concepts/linear_operator.hpp>
#include <slant/contact/contact_data.hpp>

#include <Eigen/Geometry>

#include <cmath>
#include <fem/steel_brick.hpp>
#include <oracle/dense_contact_reference.hpp>
#include <vector>

namespace test {

inline slant::contact::data<double> contact_data(fem::contact_scene<3> const& s) {
  return {s.N, s.T, s.f, s.d, s.g};
}

/// The same without friction.
inline slant::contact::data<double> frictionless_data(fem::contact_scene<3> const& s) {
  return {s.N, Eigen::SparseMatrix<double>(0, s.f.size()), s.f, s.d, Eigen::VectorXd(0)};
}

/// A body of the plane: the brick's degrees of freedom with its first tangent only.
inline slant::contact::data<double> one_tangent(fem::contact_scene<3> const& s) {
  std::vector<slant::index> first;
  for (Eigen::Index i = 0; i < s.d.size(); ++i) first.push_back(2 * i);
  Eigen::SparseMatrix<double> const T =
      slant::detail::columns_of_identity<double>(s.T.rows(), first).transpose() * s.T;
  return {s.N, T, s.f, s.d, s.g};
}

/// n > 1 nodes in a row, springs of stiffness 1; of these stiffnesses to the walls at both ends.
inline Eigen::SparseMatrix<double> springs(Eigen::Index n, double first = 1, double last = 1) {
  Eigen::MatrixXd K = 2 * Eigen::MatrixXd::Identity(n, n);
  K.diagonal(1).setConstant(-1);
  K.diagonal(-1).setConstant(-1);
  K(0, 0) = first + 1;
  K(n - 1, n - 1) = last + 1;
  return K.sparseView();
}

/// Turns each node's displacement, the three unknowns of which follow each other.
inline Eigen::SparseMatrix<double> rotation(Eigen::Index n) {
  Eigen::Matrix3d const Q =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  Eigen::SparseMatrix<double> turn(n, n);
  turn.reserve(Eigen::VectorXi::Constant(n, 3));
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index a = 0; a < 3; ++a) turn.insert(i, i / 3 * 3 + a) = Q(i % 3, a);
  return turn;
}

inline oracle::contact_reference reference(Eigen::SparseMatrix<double> const& K,
                                           slant::contact::data<double> const& c) {
  return oracle::solve_contact({K, c.N, c.T, c.f, c.d, c.g});
}

/// √(λᵀA λ).
template <class A>
double energy_norm(A const& a, Eigen::VectorXd const& λ) {
  Eigen::VectorXd image(λ.size());
  slant::apply(a, λ, image);
  return std::sqrt(λ.dot(image));
}

}  // namespace test
