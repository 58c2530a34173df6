// SPDX-License-Identifier: MIT
// case USE=alone REDUCED_GRADIENT: solve: the rule must judge states of this method.*'has_verdict['<]
// case USE=combined REDUCED_GRADIENT: 'has_verdict['<]
// case USE=combined REDUCED_GRADIENT, max-lines-gcc: 25
// case USE=second REDUCED_GRADIENT: solve_then: the second rule must judge states of the second method
// case USE=second REDUCED_GRADIENT, max-lines-clang: 20
// max-lines-gcc: 20
// max-lines-clang: 30
//
// The rule of KPRGP for conjugate gradients, whose state has a residual and no reduced gradient: alone,
// in a combination of rules, for the second of two methods.
#include <slant/slant.hpp>

#ifdef REDUCED_GRADIENT
auto const accurate = slant::reduced_gradient_below(1e-8);
#else
auto const accurate = slant::residual_below(1e-8);
#endif

auto alone(auto const& method, Eigen::VectorXd const& b) {
  return slant::solve(method, b, accurate);
}
auto combined(auto const& method, Eigen::VectorXd const& b) {
  return slant::solve(method, b, accurate || slant::at_most(500));
}
auto second(auto const& method, Eigen::VectorXd const& b) {
  return slant::solve_then(method, slant::residual_below(1e-2), method, b, accurate);
}

auto solution(Eigen::VectorXd const& b) {
  return USE(slant::cg{slant::identity_operator(b.size()), b}, b);
}
