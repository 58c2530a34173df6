// SPDX-License-Identifier: MIT
// case MATRIX: solve_nested: a prolongation must be a linear operator on vectors like x0
// case WITHOUT_PROLONGATION: solve_nested: a level must have method.., stop.. and prolongation..
// case WITHOUT_PROLONGATION, max-lines-gcc: 15
// case WITHOUT_PROLONGATION, max-lines-clang: 20
// max-lines-gcc: 25
// max-lines-clang: 30
//
// A level with an Eigen matrix where an operator is needed, for which the call of slant::matrix is
// missing; a level minus its prolongation.
#include <slant/slant.hpp>

struct level {
  Eigen::VectorXd b;
  Eigen::MatrixXd P;
  auto method() const { return slant::cg{slant::identity_operator(b.size()), b}; }
  auto stop() const { return slant::at_most(3); }
#if defined(MATRIX)
  auto const& prolongation() const { return P; }
#elif !defined(WITHOUT_PROLONGATION)
  auto prolongation() const { return slant::matrix(P); }
#endif
};

auto solution(std::vector<level> const& levels, Eigen::VectorXd const& x0) {
  return slant::solve_nested(levels, x0);
}
