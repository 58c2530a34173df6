// SPDX-License-Identifier: MIT
// expect: every block of the set must have a smooth inequality form
// max-lines-gcc: 40
// max-lines-clang: 40
//
// A block minus its smooth inequality form.
#include <slant/sets/power.hpp>
#include <slant/slanting/kkt_function.hpp>

struct upper_half_plane {
  static constexpr int dimension = 2;
  Eigen::Vector2d project(auto const& x) const { return {x[0], x[1] < 0 ? 0 : x[1]}; }
  bool contains(auto const& x) const { return x[1] >= 0; }
#ifdef SLANT_COMPLETE
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

auto conditions(Eigen::MatrixXd const& A, Eigen::VectorXd const& b) {
  return slant::kkt(A, b, slant::power(upper_half_plane{}, 3), 0.5);
}
