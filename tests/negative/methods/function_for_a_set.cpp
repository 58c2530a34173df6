// SPDX-License-Identifier: MIT
// case SOLVER=kprgp A_FUNCTION: expected a separable_qp with a convex set, not with another function
// case SOLVER=interior_point A_FUNCTION: expected a separable_qp with a convex set, not with another function
// case SOLVER=mssn A_FUNCTION: expected a separable_qp with a convex set, not with another function
// case SOLVER=symmetric_newton TWO_FUNCTIONS: q . phi . psi: only one function is added
// case SOLVER=symmetric_newton MINUS: q - phi need not be convex
// max-lines-gcc: 12
// max-lines-clang: 20
//
// A norm where a method follows the faces of a set; two of them, or one with the wrong sign.
#include <slant/slant.hpp>

auto solution(Eigen::VectorXd const& b) {
  auto const q = slant::quadratic(slant::identity_operator(b.size()), b);
  auto const set = slant::intervals(b);
#ifdef A_FUNCTION
  auto const program = slant::minimise(q + slant::support(set));
#elif defined TWO_FUNCTIONS
  auto const program = slant::minimise(q + slant::support(set) + slant::support(set));
#elif defined MINUS
  auto const program = slant::minimise(q - slant::support(set));
#else
  auto const program = slant::minimise(q).over(set);
#endif
  return slant::solve(slant::SOLVER{program}, b,
                      slant::reduced_gradient_below(1e-8) || slant::at_most(500));
}
