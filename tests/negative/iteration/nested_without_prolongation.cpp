// SPDX-License-Identifier: MIT
// expect: solve_nested: a level must have method.., stop.. and prolongation..
// max-lines-gcc: 15
// max-lines-clang: 20
//
// A level minus its prolongation.
#include <slant/iteration/nested.hpp>
#include <slant/krylov/cg.hpp>
#include <slant/operators/identity.hpp>

#include <Eigen/Core>
#include <vector>

struct level {
  Eigen::VectorXd b;
  auto method() const { return slant::cg{slant::identity_operator(b.size()), b}; }
  auto stop() const { return slant::at_most(3); }
#ifdef SLANT_COMPLETE
  auto prolongation() const { return slant::identity_operator(b.size()); }
#endif
};

auto solution(std::vector<level> const& levels, Eigen::VectorXd const& x0) {
  return slant::solve_nested(levels, x0);
}
