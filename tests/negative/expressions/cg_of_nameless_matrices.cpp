// SPDX-License-Identifier: MIT
// expect: adjoint.matrix. at the end is not adjoint.matrix. as far as types tell: name both by op.*A must have the laws
// expect-clang: not self_adjoint.*as far as types tell: nam.*e both by op.*A must have the laws
// max-lines-gcc: 12
// max-lines-clang: 20
//
// Two matrices that happen to be one: the compiler sees two.
#include <slant/krylov/cg.hpp>
#include <slant/operators/operators.hpp>

auto method(Eigen::MatrixXd const& matrix, Eigen::VectorXd const& b) {
  auto const I = slant::identity(matrix.cols());
#ifdef SLANT_COMPLETE
  auto const B = slant::op<"B">(matrix);
  auto const A = B * adjoint(B) + slant::identity(matrix.rows());
#else
  auto const A = slant::matrix(matrix) * I * adjoint(+slant::matrix(matrix));
#endif
  return slant::cg{A, b};
}
