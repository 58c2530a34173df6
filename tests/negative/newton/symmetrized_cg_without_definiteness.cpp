// SPDX-License-Identifier: MIT
// expect: symmetrized_cg: F.*must be I.*self-adjoint and definite
// max-lines-gcc: 30
// max-lines-clang: 40
//
// A natural residual with a matrix about which nothing is promised.
#include <slant/iteration/solve.hpp>
#include <slant/newton/semismooth_newton.hpp>
#include <slant/sets/contact_sets.hpp>
#include <slant/slanting/natural_residual.hpp>

auto run(Eigen::MatrixXd const& matrix, Eigen::VectorXd const& b) {
#ifdef SLANT_COMPLETE
  auto const A = slant::matrix<slant::self_adjoint, slant::positive_definite>(matrix);
#else
  auto const A = slant::matrix(matrix);
#endif
  auto const F = slant::natural_residual(A, b, slant::half_lines(b.size()), 1.0);
  slant::semismooth_newton const method{F, slant::symmetrized_cg{}};
  return slant::solve(method, b, slant::residual_below(1e-10)).status;
}
