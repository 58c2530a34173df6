// SPDX-License-Identifier: MIT
// expect: cg_solver: F.*must declare self_adjoint and positive_definite
// max-lines-gcc: 30
// max-lines-clang: 40
//
// The gradient of a convex function whose Hessian nobody has declared definite.
#include <slant/iteration/solve.hpp>
#include <slant/newton/semismooth_newton.hpp>
#include <slant/slanting/affine.hpp>

auto run(Eigen::MatrixXd const& matrix, Eigen::VectorXd const& b) {
#ifdef SLANT_COMPLETE
  auto const A = slant::matrix<slant::self_adjoint, slant::positive_definite>(matrix);
#else
  auto const A = slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(matrix);
#endif
  auto const F = slant::affine(A, -b);
  slant::semismooth_newton const method{F, slant::cg_solver{}};
  return slant::solve(method, b, slant::residual_below(1e-10)).status;
}
