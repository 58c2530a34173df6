// SPDX-License-Identifier: MIT
// expect: A must.*has_plain_apply
// expect-clang: A must.*'has_plain_apply['<]
// max-lines-gcc: 20
// max-lines-clang: 30
//
// A matrix is not an operator: slant::matrix(A) makes one of it.
#include <slant/operators/matrix.hpp>
#include <slant/problems/separable_qp.hpp>
#include <slant/sets/contact_sets.hpp>

auto problem(Eigen::MatrixXd const& A, Eigen::VectorXd const& b) {
#ifdef SLANT_COMPLETE
  return slant::separable_qp{slant::matrix(A), b, slant::half_lines(b.size())};
#else
  return slant::separable_qp{A, b, slant::half_lines(b.size())};
#endif
}
