// SPDX-License-Identifier: MIT
// expect: A must.*has_plain_apply
// expect-clang: A must.*'has_plain_apply['<]
// max-lines-gcc: 20
// max-lines-clang: 35
//
// A matrix is not an operator, and promises nothing: slant::matrix<laws…>(K) does.
#include <slant/krylov/cg.hpp>
#include <slant/operators/declare.hpp>

auto method(Eigen::MatrixXd const& K, Eigen::VectorXd const& b) {
#ifdef SLANT_COMPLETE
  return slant::cg{slant::declare<slant::self_adjoint, slant::positive_definite>(K), b};
#else
  return slant::cg{K, b};
#endif
}
