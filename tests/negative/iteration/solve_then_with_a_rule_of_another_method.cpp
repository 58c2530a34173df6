// SPDX-License-Identifier: MIT
// expect: solve_then: the second rule must judge states of the second method
// max-lines-gcc: 20
// max-lines-clang: 20
//
// Two methods minus a rule that understands the second one: cg has no reduced gradient.
#include <slant/iteration/solve_then.hpp>
#include <slant/krylov/cg.hpp>
#include <slant/operators/identity.hpp>

#include <Eigen/Core>

auto solution(Eigen::VectorXd const& b) {
  slant::cg const method{slant::identity_operator(b.size()), b};
#ifdef SLANT_COMPLETE
  auto const stop = slant::residual_below(1e-8);
#else
  auto const stop = slant::reduced_gradient_below(1e-8);
#endif
  return slant::solve_then(method, slant::residual_below(1e-2), method, b, stop);
}
