// SPDX-License-Identifier: MIT
// case WITHOUT_SLANT: a function of blocks with slant\(ρ, z\)
// case WITHOUT_PROX: the set must be a convex set of vectors like b, or a function with prox
// case WITHOUT_PROX, max-lines-clang: 45
// max-lines-gcc: 20
// max-lines-clang: 30
//
// A function minus the slanting operator of its proximal map, and what is neither a set nor a function.
#include <slant/slant.hpp>

struct half_square {
  static constexpr int dimension = 2;
#ifndef WITHOUT_PROX
  Eigen::Vector2d prox(double ρ, auto const& z) const { return z / (1 + ρ); }
#endif
  double value(auto const& x) const { return x.squaredNorm() / 2; }
#ifndef WITHOUT_SLANT
  Eigen::Matrix2d slant(double ρ, auto const&) const {
    return Eigen::Matrix2d::Identity() / (1 + ρ);
  }
#endif
};

auto solution(Eigen::VectorXd const& b) {
  auto const program = slant::separable_qp{slant::identity_operator(2), b, half_square{}};
  return slant::solve(slant::symmetric_newton{program}, b,
                      slant::reduced_gradient_below(1e-8) || slant::at_most(500));
}
