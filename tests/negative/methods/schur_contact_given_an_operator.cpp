// SPDX-License-Identifier: MIT
// expect: schur_contact: the problem must be a polyhedral_qp
// max-lines-gcc: 20
// max-lines-clang: 30
//
// A method needs a problem, not a stiffness.
#include <slant/iteration/solve.hpp>
#include <slant/methods/schur_contact.hpp>
#include <slant/operators/identity.hpp>

auto solution(Eigen::VectorXd const& f, slant::constraint_rows<double> const& rows) {
  slant::identity_operator const one(2);
#ifdef SLANT_COMPLETE
  auto const problem = slant::polyhedral_qp{one, f, rows, slant::no_projector(2)};
#else
  auto const& problem = one;
#endif
  return slant::solve(slant::schur_contact{problem}, f,
                      slant::residual_below(1e-8) || slant::at_most(500));
}
