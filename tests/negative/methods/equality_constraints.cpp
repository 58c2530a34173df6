// SPDX-License-Identifier: MIT
// case METHOD=smalse MATRIX: the constraints must be equality_constraints
// case METHOD=constrained_newton MATRIX: the constraints must be equality_constraints
// case METHOD=smalse WITHOUT_SEMIDEFINITENESS: A must declare.*'declares_positive_semidefinite['<]
// case METHOD=smalse WITHOUT_SEMIDEFINITENESS, clang: A must declare
// max-lines-gcc: 20
// max-lines-clang: 30
//
// G alone instead of G x = e; an operator that promises to be self-adjoint and not that
// q(x) = ½ xᵀA x − bᵀx is convex.
#include <slant/iteration/solve.hpp>
#include <slant/methods/constrained_newton.hpp>
#include <slant/methods/smalse.hpp>
#include <slant/problems/equality_constraints.hpp>
#include <slant/sets/contact_sets.hpp>

struct twice {
#ifdef WITHOUT_SEMIDEFINITENESS
  static constexpr auto laws = slant::laws<slant::self_adjoint>;
#else
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::positive_semidefinite>;
#endif
  Eigen::Index rows() const { return 2; }
  Eigen::Index cols() const { return 2; }
  void apply(auto const& x, auto& y) const { y = 2 * x; }
};

auto solution(Eigen::VectorXd const& b, Eigen::SparseMatrix<double> const& G) {
  auto const set = slant::half_lines(b.size());
  auto const qp = slant::separable_qp{twice{}, b, set};
#ifdef MATRIX
  auto const& constraints = G;
#else
  Eigen::VectorXd const e = Eigen::VectorXd::Zero(G.rows());
  slant::equality_constraints const constraints(G, e);
#endif
  return slant::solve(slant::METHOD{qp, constraints}, b,
                      slant::reduced_gradient_below(1e-8) || slant::at_most(500));
}
