// SPDX-License-Identifier: MIT
// expect: expected a separable_qp.*'has_hessian['<]
// max-lines-gcc: 20
// max-lines-clang: 30
//
// The operator alone instead of the quadratic program.
#include <slant/iteration/solve.hpp>
#include <slant/methods/kprgp.hpp>
#include <slant/operators/identity.hpp>
#include <slant/sets/contact_sets.hpp>

auto solution(Eigen::VectorXd const& b) {
  slant::identity_operator const A(b.size());
  auto const set = slant::half_lines(b.size());
#ifdef SLANT_COMPLETE
  auto const qp = slant::separable_qp{A, b, set};
#else
  auto const& qp = A;
#endif
  return slant::solve(slant::kprgp{qp}, b,
                      slant::reduced_gradient_below(1e-8) || slant::at_most(500));
}
