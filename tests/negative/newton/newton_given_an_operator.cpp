// SPDX-License-Identifier: MIT
// expect: semismooth_newton: expected a slanting function.*has_value_member
// max-lines-gcc: 20
// max-lines-clang: 20
//
// A matrix is not a function F: for A y = b there is affine(A, -b).
#include <slant/iteration/solve.hpp>
#include <slant/newton/semismooth_newton.hpp>
#include <slant/slanting/affine.hpp>

auto run(Eigen::MatrixXd const& A, Eigen::VectorXd const& b) {
#ifdef SLANT_COMPLETE
  auto const F = slant::affine(A, -b);
#else
  auto const F = slant::matrix(A);
#endif
  return slant::solve(slant::semismooth_newton{F}, b, slant::residual_below(1e-10)).status;
}
