// SPDX-License-Identifier: MIT
// case USE=projection WITHOUT_SLANT: 'has_slant_member['<]
// case USE=residual WITHOUT_SLANT: 'has_projection_slant['<]
// case USE=conditions WITHOUT_INEQUALITY: every block of the set must have a smooth inequality form
// case USE=conditions WITHOUT_INEQUALITY, max-lines-gcc: 40
// case USE=conditions WITHOUT_INEQUALITY, max-lines-clang: 40
// max-lines-gcc: 25
// max-lines-clang: 30
//
// A block minus the slanting operator of its projection, or minus its smooth inequality form.
#include <slant/sets/power.hpp>
#include <slant/slanting/kkt_function.hpp>
#include <slant/slanting/natural_residual.hpp>
#include <slant/slanting/projection.hpp>

struct upper_half_plane {
  static constexpr int dimension = 2;
  Eigen::Vector2d project(auto const& x) const { return {x[0], x[1] < 0 ? 0 : x[1]}; }
  bool contains(auto const& x) const { return x[1] >= 0; }
#ifndef WITHOUT_SLANT
  Eigen::Matrix2d slant(auto const& x) const {
    return Eigen::Vector2d(1, x[1] < 0 ? 0 : 1).asDiagonal();
  }
#endif
#ifndef WITHOUT_INEQUALITY
  static constexpr int inequalities = 1;
  Eigen::Matrix<double, 1, 1> inequality(auto const& x) const {
    return Eigen::Matrix<double, 1, 1>::Constant(-x[1]);
  }
  Eigen::Vector2d inequality_gradient(auto const&) const { return {0, -1}; }
  Eigen::Matrix2d inequality_hessian(auto const&, auto const&) const {
    return Eigen::Matrix2d::Zero();
  }
#endif
};

auto projection(auto const& block, Eigen::MatrixXd const&, Eigen::VectorXd const&) {
  return slant::projection(block);
}
auto residual(auto const& block, Eigen::MatrixXd const& A, Eigen::VectorXd const& b) {
  return slant::natural_residual(A, b, slant::power(block, 3), 0.5);
}
auto conditions(auto const& block, Eigen::MatrixXd const& A, Eigen::VectorXd const& b) {
  return slant::kkt(A, b, slant::power(block, 3), 0.5);
}

auto function(Eigen::MatrixXd const& A, Eigen::VectorXd const& b) {
  return USE(upper_half_plane{}, A, b);
}
