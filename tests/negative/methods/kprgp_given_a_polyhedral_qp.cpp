// SPDX-License-Identifier: MIT
// expect: expected a separable_qp.*'has_hessian['<]
// max-lines-gcc: 20
// max-lines-clang: 30
//
// A problem of another kind, which has vectors and a scalar as well.
#include <slant/iteration/solve.hpp>
#include <slant/methods/kprgp.hpp>
#include <slant/operators/identity.hpp>
#include <slant/problems/polyhedral_qp.hpp>
#include <slant/sets/contact_sets.hpp>

auto solution(Eigen::VectorXd const& b, slant::constraint_rows<double> const& rows) {
  slant::identity_operator const A(b.size());
#ifdef SLANT_COMPLETE
  auto const qp = slant::separable_qp{A, b, slant::half_lines(rows.count())};
#else
  auto const qp = slant::polyhedral_qp{A, b, rows, slant::no_projector(b.size())};
#endif
  return slant::solve(slant::kprgp{qp}, b,
                      slant::reduced_gradient_below(1e-8) || slant::at_most(500));
}
