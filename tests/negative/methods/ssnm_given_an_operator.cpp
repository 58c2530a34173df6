// SPDX-License-Identifier: MIT
// expect: expected a separable_qp
// max-lines-gcc: 20
// max-lines-clang: 30
//
// The operator alone instead of the quadratic program.
#include <slant/iteration/solve.hpp>
#include <slant/methods/ssnm.hpp>
#include <slant/newton/krylov_solvers.hpp>
#include <slant/operators/matrix.hpp>
#include <slant/sets/contact_sets.hpp>

auto solution(Eigen::SparseMatrix<double> const& K, Eigen::VectorXd const& b) {
  auto const A = slant::matrix<slant::self_adjoint, slant::positive_definite>(K);
  auto const set = slant::half_lines(b.size());
#ifdef SLANT_COMPLETE
  auto const qp = slant::separable_qp{A, b, set};
#else
  auto const& qp = A;
#endif
  return slant::solve(slant::ssnm{qp, slant::bicgstab_solver{}}, b, slant::at_most(500));
}
