// SPDX-License-Identifier: MIT
// expect: the constraints must be equality_constraints
// max-lines-gcc: 20
// max-lines-clang: 30
//
// G alone instead of G x = e.
#include <slant/iteration/solve.hpp>
#include <slant/methods/smalse.hpp>
#include <slant/problems/equality_constraints.hpp>
#include <slant/sets/contact_sets.hpp>

auto solution(Eigen::VectorXd const& b, Eigen::SparseMatrix<double> const& G) {
  auto const qp = slant::separable_qp{slant::identity(b.size()), b, slant::half_lines(b.size())};
#ifdef SLANT_COMPLETE
  Eigen::VectorXd const e = Eigen::VectorXd::Zero(G.rows());
  slant::equality_constraints const constraints(G, e);
#else
  auto const& constraints = G;
#endif
  return slant::solve(slant::smalse{qp, constraints}, b,
                      slant::reduced_gradient_below(1e-8) || slant::at_most(500));
}
