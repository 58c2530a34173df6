// SPDX-License-Identifier: MIT
// expect: 'has_projection_slant['<]
// max-lines-gcc: 25
// max-lines-clang: 30
//
// The blocks of a product minus the slanting operator of their projection.
#include <slant/sets/power.hpp>
#include <slant/slanting/natural_residual.hpp>

struct upper_half_plane {
  static constexpr int dimension = 2;
  Eigen::Vector2d project(auto const& x) const { return {x[0], x[1] < 0 ? 0 : x[1]}; }
  bool contains(auto const& x) const { return x[1] >= 0; }
#ifdef SLANT_COMPLETE
  Eigen::Matrix2d slant(auto const& x) const {
    return Eigen::Vector2d(1, x[1] < 0 ? 0 : 1).asDiagonal();
  }
#endif
};

auto residual(Eigen::MatrixXd const& A, Eigen::VectorXd const& b) {
  return slant::natural_residual(A, b, slant::power(upper_half_plane{}, 3), 0.5);
}
