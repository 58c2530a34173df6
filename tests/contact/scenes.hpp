// SPDX-License-Identifier: MIT
//
// Small contact scenes for the tests of this room.
#pragma once

#include <slant/concepts/linear_operator.hpp>
#include <slant/contact/contact_data.hpp>

#include <cmath>
#include <fem/steel_brick.hpp>
#include <oracle/dense_contact_reference.hpp>

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
  Eigen::SparseMatrix<double> T(s.d.size(), s.f.size());
  for (Eigen::Index i = 0; i < s.d.size(); ++i) {
    for (Eigen::Index j = 0; j < s.f.size(); ++j) {
      if (s.T.coeff(2 * i, j) != 0) T.insert(i, j) = s.T.coeff(2 * i, j);
    }
  }
  return {s.N, T, s.f, s.d, s.g};
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
