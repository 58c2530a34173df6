// SPDX-License-Identifier: MIT
// case NO_ADJOINT: B . inverse.K. . B . c . I".*not self_adjoint: in the term B . inverse.K. . B, B at the end is not adjoint.B.".*A must have the laws
// case NO_ADJOINT, clang: B . inverse.K. . B . c . I".*not self_adjoint: in the term B".*is not adjoint.B.".*A must have the laws
// case NAMELESS: adjoint.matrix. at the end is not adjoint.matrix. as far as types tell: name both by op.*A must have the laws
// case NAMELESS, clang: not self_adjoint.*as far as types tell: nam.*e both by op.*A must have the laws
// case MINUS: -B . inverse.K. . adjoint.B.".*not positive_semidefinite: a minus stands before B . inverse.K. . adjoint.B.".*A must have the laws
// case MINUS, clang: "-B . inverse.K. . adjoint.B.".*not positive_semidefinite: a mi.*nus stands before B.*A must have the laws
// case COLUMN: an operator and a vector cannot be added
// max-lines-gcc: 12
// max-lines-clang: 20
//
// B K⁻¹ B where B K⁻¹ Bᵀ is meant: the first line shows the formula and the place. Two matrices that
// happen to be one: the compiler sees two. A maximum written as a minimum. The linear term
// added to the operator.
#include <slant/slant.hpp>

auto method(Eigen::MatrixXd const& matrix, Eigen::MatrixXd const& stiffness,
            Eigen::VectorXd const& b) {
  auto const B = slant::op<"B">(matrix);
  auto const Kinv = inverse(slant::op<"K">(slant::dense_ldlt(stiffness)));
  auto const I = 1e-3 * slant::identity(matrix.rows());
#if defined(NO_ADJOINT)
  auto const A = B * Kinv * B + I;
#elif defined(NAMELESS)
  auto const A = slant::matrix(matrix) * Kinv * adjoint(+slant::matrix(matrix));
#elif defined(MINUS)
  auto const A = -(B * Kinv * adjoint(B));
#elif defined(COLUMN)
  auto const A = b - (B * Kinv * adjoint(B) + I);
#else
  auto const A = B * Kinv * adjoint(B) + I;
#endif
  return slant::cg{A, b};
}
