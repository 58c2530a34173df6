// SPDX-License-Identifier: MIT
// case MATRIX: A must.*has_plain_apply
// case MATRIX, clang: A must.*'has_plain_apply['<]
// case MATRIX, max-lines-gcc: 20
// case MATRIX, max-lines-clang: 35
// case DEPENDENT_ROWS: matrix . adjoint.matrix.*assert full_row_rank.matrix.*A must have the laws
// case DEPENDENT_ROWS, clang: matrix . adjoint.matrix.*sert full_row_rank.matrix.*A must have the laws
// case ANY_SIGN: a number of any sign stands before I.*A must have the laws
// case ANY_SIGN, clang: mber of any sign stands before .*A must have the laws
// case EXPRESSION: b must be a slant::vector.*'owns_its_entries['<]
// case EXPRESSION, max-lines-gcc: 25
// max-lines-gcc: 22
// max-lines-clang: 30
//
// A matrix is not an operator, and promises nothing: slant::matrix<laws…>(K) does. B A Bᵀ where nobody
// has asserted that the rows of B are independent; a multiple by a number of any sign; a right-hand
// side that is an expression and has no entries of its own.
#include <slant/slant.hpp>

auto with_a_matrix(Eigen::MatrixXd const& K, Eigen::VectorXd const& b) {
#ifdef MATRIX
  return slant::cg{K, b};
#else
  return slant::cg{slant::declare<slant::self_adjoint, slant::positive_definite>(K), b};
#endif
}

auto with_a_congruence(Eigen::MatrixXd const& matrix, Eigen::VectorXd const& b) {
#ifdef DEPENDENT_ROWS
  auto B = slant::matrix(matrix);
#else
  auto B = slant::full_row_rank(matrix);
#endif
  return slant::cg{slant::congruence(std::move(B), slant::identity_operator(matrix.cols())), b};
}

#ifdef ANY_SIGN
auto const two = slant::any_sign(2.0);
#else
auto const two = 2.0;
#endif
auto with_a_multiple(Eigen::VectorXd const& b) {
  return slant::cg{slant::scaled(two, slant::identity_operator(2)), b};
}

auto with_an_expression(Eigen::VectorXd const& b) {
#ifdef EXPRESSION
  return slant::bicgstab{slant::identity_operator(2), -b};
#else
  return slant::bicgstab{slant::identity_operator(2), Eigen::VectorXd(-b)};
#endif
}
