// SPDX-License-Identifier: MIT
// case SOLVER=cg_solver WITHOUT_DEFINITENESS: cg_solver: F.*must declare self_adjoint and positive_definite
// case SOLVER=symmetrized_cg WITHOUT_DEFINITENESS: symmetrized_cg: F.*must be I.*self-adjoint and definite
// max-lines-gcc: 30
// max-lines-clang: 40
//
// The gradient of a convex function whose Hessian nobody has declared definite; a natural residual
// with a matrix that promises to be semidefinite alone.
#include <slant/slant.hpp>

auto function_for(slant::cg_solver const&, auto const& A, Eigen::VectorXd const& b) {
  return slant::affine(A, -b);
}
auto function_for(slant::symmetrized_cg const&, auto const& A, Eigen::VectorXd const& b) {
  return slant::natural_residual(A, b, slant::half_lines(b.size()), 1.0);
}

auto run(Eigen::MatrixXd const& matrix, Eigen::VectorXd const& b) {
#ifdef WITHOUT_DEFINITENESS
  auto const A = slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(matrix);
#else
  auto const A = slant::matrix<slant::self_adjoint, slant::positive_definite>(matrix);
#endif
  auto const F = function_for(slant::SOLVER{}, A, b);
  slant::semismooth_newton const method{F, slant::SOLVER{}};
  return slant::solve(method, b, slant::residual_below(1e-10)).status;
}
