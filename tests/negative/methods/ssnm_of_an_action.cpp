// SPDX-License-Identifier: MIT
// expect: schur_bicgstab: F°\(y\) must be that of slant::kkt with an Eigen matrix A
// max-lines-gcc: 25
// max-lines-clang: 30
//
// Variant A, which factors A, for an operator that is no matrix.
#include <slant/iteration/solve.hpp>
#include <slant/methods/ssnm.hpp>
#include <slant/operators/identity.hpp>
#include <slant/operators/matrix.hpp>
#include <slant/sets/contact_sets.hpp>

auto solution(Eigen::SparseMatrix<double> const& K, Eigen::VectorXd const& b) {
#ifdef SLANT_COMPLETE
  auto const A = slant::matrix<slant::self_adjoint, slant::positive_definite>(K);
#else
  slant::identity_operator const A(K.rows());
#endif
  auto const set = slant::half_lines(b.size());
  auto const qp = slant::separable_qp{A, b, set};
  return slant::solve(slant::ssnm{qp}, b, slant::at_most(500));
}
