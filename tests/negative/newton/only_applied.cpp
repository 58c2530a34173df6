// SPDX-License-Identifier: MIT
// case WITHOUT_COLUMNS: direct_solver: F.*must be a matrix, or have columns or an inverse
// case WITHOUT_DIAGONAL: equilibrated: A must have diagonal\(d\); without it, give the factors d
// case WITHOUT_DIAGONAL, max-lines-gcc: 14
// case WITHOUT_DIAGONAL, max-lines-clang: 14
// max-lines-gcc: 40
// max-lines-clang: 50
//
// A derivative that can only be applied, an operator that does not give its diagonal.
#include <slant/slant.hpp>

struct twice {
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::positive_definite>;
  Eigen::Index rows() const { return 2; }
  Eigen::Index cols() const { return 2; }
  void apply(auto const& x, auto& y) const { y = 2 * x; }
#ifndef WITHOUT_COLUMNS
  void columns(Eigen::Index first, auto& y) const {
    y = 2 * Eigen::Matrix2d::Identity().middleCols(first, y.cols());
  }
#endif
#ifndef WITHOUT_DIAGONAL
  void diagonal(auto& d) const { d.setConstant(2); }
#endif
};

auto run(Eigen::VectorXd const& b) {
  auto const F = slant::linear(twice{});
  slant::semismooth_newton const method{F, slant::direct_solver{}};
  return slant::solve(method, b, slant::residual_below(1e-10)).status;
}
auto factors(Eigen::VectorXd const& b) {
  auto const set = slant::half_lines(b.size());
  slant::separable_qp const qp{twice{}, b, set};
  return slant::equilibrated(qp).d();
}
