// SPDX-License-Identifier: MIT
// case SOLVER=bicgstab_solver GIVEN_AN_OPERATOR: expected a separable_qp
// case SOLVER=bicgstab_solver GIVEN_AN_OPERATOR, max-lines-gcc: 20
// case SOLVER=schur_bicgstab ACTION: schur_bicgstab: F°\(y\) must be that of slant::kkt with an Eigen matrix A
// max-lines-gcc: 25
// max-lines-clang: 30
//
// The operator alone instead of the quadratic program; variant A, which factors A, for an operator
// that is no matrix.
#include <slant/slant.hpp>

auto solution(Eigen::SparseMatrix<double> const& K, Eigen::VectorXd const& b) {
#ifdef ACTION
  slant::identity_operator const A(K.rows());
#else
  auto const A = slant::matrix<slant::self_adjoint, slant::positive_definite>(K);
#endif
  auto const set = slant::half_lines(b.size());
#ifdef GIVEN_AN_OPERATOR
  auto const& qp = A;
#else
  auto const qp = slant::separable_qp{A, b, set};
#endif
  return slant::solve(slant::ssnm{qp, slant::SOLVER{}}, b, slant::at_most(500));
}
