// SPDX-License-Identifier: MIT
// case DENSE: cannot convert '.*Eigen::Matrix<double.*Eigen::SparseMatrix<double
// case DENSE, clang: no viable conversion from '.*Eigen::MatrixXd.*Eigen::SparseMatrix
// case WITHOUT_SEMIDEFINITENESS: A must declare.*'declares_positive_semidefinite['<]
// case WITHOUT_SEMIDEFINITENESS, clang: A must declare
// max-lines-gcc: 20
// max-lines-clang: 30
//
// Equations G x = e with a dense G; a program with equations, of which solve asks that q is convex.
#include <slant/methods/constrained_newton.hpp>
#include <slant/problems/minimise.hpp>
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

auto solution(Eigen::VectorXd const& b, Eigen::MatrixXd const& G, Eigen::VectorXd const& e) {
#ifdef DENSE
  auto const& rows = G;
#else
  Eigen::SparseMatrix<double> const rows = G.sparseView();
#endif
  auto const program = slant::minimise(slant::quadratic(twice{}, b))
                           .over(slant::half_lines(b.size()))
                           .subject_to(rows, e);
  return slant::solve(program, 1e-8).converged();
}
