// SPDX-License-Identifier: MIT
// expect: A must.*'declares_positive_definite['<]
// max-lines-gcc: 22
// max-lines-clang: 30
//
// B A Bᵀ where nobody has asserted that the rows of B are independent.
#include <slant/krylov/cg.hpp>
#include <slant/operators/identity.hpp>
#include <slant/operators/product.hpp>

auto method(Eigen::MatrixXd const& matrix, Eigen::VectorXd const& b) {
#ifdef SLANT_COMPLETE
  auto B = slant::full_row_rank(matrix);
#else
  auto B = slant::matrix(matrix);
#endif
  return slant::cg{slant::congruence(std::move(B), slant::identity_operator(matrix.cols())), b};
}
