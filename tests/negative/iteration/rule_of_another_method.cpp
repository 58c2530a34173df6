// SPDX-License-Identifier: MIT
// expect: solve: the rule must judge states of this method.*'has_verdict['<]
// max-lines-gcc: 20
// max-lines-clang: 30
//
// The rule of KPRGP for conjugate gradients, whose state has a residual and no reduced gradient.
#include <slant/iteration/solve.hpp>
#include <slant/krylov/cg.hpp>
#include <slant/operators/identity.hpp>

#include <Eigen/Core>

#ifdef SLANT_COMPLETE
auto const accurate = slant::residual_below(1e-8);
#else
auto const accurate = slant::reduced_gradient_below(1e-8);
#endif

auto solution(Eigen::VectorXd const& b) {
  return slant::solve(slant::cg{slant::identity_operator(2), b}, b, accurate);
}
