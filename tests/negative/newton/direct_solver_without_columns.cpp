// SPDX-License-Identifier: MIT
// expect: direct_solver: F.*must be a matrix, or have columns or an inverse
// max-lines-gcc: 40
// max-lines-clang: 50
//
// A derivative that can only be applied.
#include <slant/slant.hpp>

struct twice {
  Eigen::Index rows() const { return 2; }
  Eigen::Index cols() const { return 2; }
  void apply(auto const& x, auto& y) const { y = 2 * x; }
#ifdef SLANT_COMPLETE
  void columns(Eigen::Index first, auto& y) const {
    y = 2 * Eigen::Matrix2d::Identity().middleCols(first, y.cols());
  }
#endif
};

auto run(Eigen::VectorXd const& b) {
  auto const F = slant::linear(twice{});
  slant::semismooth_newton const method{F, slant::direct_solver{}};
  return slant::solve(method, b, slant::residual_below(1e-10)).status;
}
