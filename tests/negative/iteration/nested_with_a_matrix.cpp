// SPDX-License-Identifier: MIT
// expect: solve_nested: a prolongation must be a linear operator on vectors like x0
// max-lines-gcc: 25
// max-lines-clang: 30
//
// An Eigen matrix where an operator is needed: the call of slant::matrix is missing.
#include <slant/iteration/nested.hpp>
#include <slant/krylov/cg.hpp>
#include <slant/operators/identity.hpp>
#include <slant/operators/matrix.hpp>

#include <Eigen/Core>
#include <vector>

struct level {
  Eigen::VectorXd b;
  Eigen::MatrixXd P;
  auto method() const { return slant::cg{slant::identity_operator(b.size()), b}; }
  auto stop() const { return slant::at_most(3); }
#ifdef SLANT_COMPLETE
  auto prolongation() const { return slant::matrix(P); }
#else
  auto const& prolongation() const { return P; }
#endif
};

auto solution(std::vector<level> const& levels, Eigen::VectorXd const& x0) {
  return slant::solve_nested(levels, x0);
}
