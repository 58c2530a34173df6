// SPDX-License-Identifier: MIT
// case USE=by_smalse MATRIX: the constraints must be equality_constraints
// case USE=by_constrained_newton MATRIX: the constraints must be equality_constraints
// case USE=by_smalse WITHOUT_SEMIDEFINITENESS: A must declare.*'declares_positive_semidefinite['<]
// case USE=by_smalse WITHOUT_SEMIDEFINITENESS, clang: A must declare
// case USE=by_smalse WITHOUT_SEMIDEFINITENESS, max-lines-clang: 31
// case USE=by_schur_contact WITHOUT_SEMIDEFINITENESS: polyhedral_qp: K must declare.*declares_positive_semidefinite
// case USE=by_schur_contact WITHOUT_SEMIDEFINITENESS, clang: polyhedral_qp: K must declare.*'declares_positive_semidefinite['<]
// case USE=by_schur_contact GIVEN_AN_OPERATOR: schur_contact: the problem must be a polyhedral_qp
// case USE=by_solve DENSE: cannot convert '.*Eigen::Matrix<double.*Eigen::SparseMatrix<double
// case USE=by_solve DENSE, clang: no viable conversion from '.*Eigen::MatrixXd.*Eigen::SparseMatrix
// case USE=by_solve WITHOUT_SEMIDEFINITENESS: A must declare.*'declares_positive_semidefinite['<]
// case USE=by_solve WITHOUT_SEMIDEFINITENESS, clang: A must declare
// case USE=by_solve WITHOUT_SEMIDEFINITENESS, max-lines-clang: 34
// case USE=by_solve_over WITHOUT_SEMIDEFINITENESS: A must declare.*'declares_positive_semidefinite['<]
// case USE=by_solve_over WITHOUT_SEMIDEFINITENESS, clang: A must declare
// case USE=by_solve_with WITHOUT_SEMIDEFINITENESS: A must declare.*'declares_positive_semidefinite['<]
// case USE=by_solve_with WITHOUT_SEMIDEFINITENESS, clang: A must declare
// case USE=forgotten OTHER_BLOCKS: erased: expected a program on Eigen vectors, with a set of blocks of the kinds that
// case USE=forgotten OTHER_BLOCKS, max-lines-gcc: 12
// case USE=forgotten OTHER_BLOCKS, max-lines-clang: 22
// case USE=forgotten WITHOUT_SEMIDEFINITENESS: erased: A must declare that it is self-adjoint and positive semidefinite
// case USE=forgotten WITHOUT_SEMIDEFINITENESS, max-lines-gcc: 12
// case USE=forgotten WITHOUT_SEMIDEFINITENESS, max-lines-clang: 22
// max-lines-gcc: 20
// max-lines-clang: 30
//
// Programs with equations and of contact whose operator has not promised to be semidefinite, of which
// solve asks that q is convex; G alone, or a dense one, instead of G x = e; a stiffness instead of a
// problem; a block that any_set, a list of known kinds, does not have.
#include <slant/slant.hpp>

struct twice {
#ifdef WITHOUT_SEMIDEFINITENESS
  static constexpr auto laws = slant::laws<slant::self_adjoint>;
#else
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::positive_semidefinite>;
#endif
  Eigen::Index rows() const { return 12; }
  Eigen::Index cols() const { return 12; }
  void apply(auto const& x, auto& y) const { y = 2 * x; }
};

#ifdef MATRIX
auto const& equations(Eigen::SparseMatrix<double> const& G) {
  return G;
}
#else
auto equations(Eigen::SparseMatrix<double> const& G) {
  return slant::equality_constraints(G, Eigen::VectorXd(Eigen::VectorXd::Zero(G.rows())));
}
#endif
auto const rule = slant::reduced_gradient_below(1e-8) || slant::at_most(500);

auto by_smalse(auto const& A, Eigen::VectorXd const& b, Eigen::SparseMatrix<double> const& G) {
  auto const set = slant::half_lines(b.size());
  auto const qp = slant::separable_qp{A, b, set};
  auto const& constraints = equations(G);
  return slant::solve(slant::smalse{qp, constraints}, b, rule);
}
auto by_constrained_newton(auto const& A, Eigen::VectorXd const& b,
                           Eigen::SparseMatrix<double> const& G) {
  auto const set = slant::half_lines(b.size());
  auto const qp = slant::separable_qp{A, b, set};
  auto const& constraints = equations(G);
  return slant::solve(slant::constrained_newton{qp, constraints}, b, rule);
}

auto by_schur_contact(auto const& K, Eigen::VectorXd const& f,
                      Eigen::SparseMatrix<double> const& B) {
  slant::constraint_rows<double> const rows(B, f);
#ifdef GIVEN_AN_OPERATOR
  auto const& problem = K;
#else
  auto const problem = slant::polyhedral_qp{K, f, rows, slant::no_projector(12)};
#endif
  return slant::solve(slant::schur_contact{problem}, f,
                      slant::residual_below(1e-8) || slant::at_most(500));
}

auto by_solve(auto const& A, Eigen::VectorXd const& b, Eigen::SparseMatrix<double> const& G) {
#ifdef DENSE
  Eigen::MatrixXd const rows = G;
#else
  auto const& rows = G;
#endif
  Eigen::VectorXd const e = Eigen::VectorXd::Zero(G.rows());
  auto const set = slant::half_lines(b.size());
  auto const program = slant::minimise(slant::quadratic(A, b)).over(set).subject_to(rows, e);
  return slant::solve(program, 1e-8).converged();
}

auto by_solve_over(auto const& A, Eigen::VectorXd const& b, Eigen::SparseMatrix<double> const&) {
  auto const program = slant::minimise(slant::quadratic(A, b)).over(slant::half_lines(b.size()));
  return slant::solve(program, 1e-8).converged();
}
auto by_solve_with(auto const& A, Eigen::VectorXd const& b, Eigen::SparseMatrix<double> const&) {
  auto const f = slant::support(slant::half_lines(b.size()));
  return slant::solve(slant::minimise(slant::quadratic(A, b) + f), 1e-8).converged();
}

#ifdef OTHER_BLOCKS
using some_ball = slant::ball<4>;
#else
using some_ball = slant::ball<2>;
#endif
auto forgotten(auto const& A, Eigen::VectorXd const& b, Eigen::SparseMatrix<double> const&) {
  auto const set = slant::power(some_ball{}, 3);
  slant::separable_qp const qp{A, b, set};
  return slant::erased(qp).size();
}

auto use(Eigen::VectorXd const& b, Eigen::SparseMatrix<double> const& G) {
  return USE(twice{}, b, G);
}
