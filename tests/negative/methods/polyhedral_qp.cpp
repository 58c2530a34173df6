// SPDX-License-Identifier: MIT
// case WITHOUT_SEMIDEFINITENESS: polyhedral_qp: K must declare.*declares_positive_semidefinite
// case WITHOUT_SEMIDEFINITENESS, clang: polyhedral_qp: K must declare.*'declares_positive_semidefinite['<]
// case GIVEN_AN_OPERATOR: schur_contact: the problem must be a polyhedral_qp
// max-lines-gcc: 20
// max-lines-clang: 30
//
// A stiffness that has not promised to be semidefinite, to which schur_contact has nothing to add; a
// stiffness instead of a problem.
#include <slant/iteration/solve.hpp>
#include <slant/methods/schur_contact.hpp>

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

auto solution(Eigen::VectorXd const& f, slant::constraint_rows<double> const& rows) {
#ifdef GIVEN_AN_OPERATOR
  auto const problem = twice{};
#else
  auto const problem = slant::polyhedral_qp{twice{}, f, rows, slant::no_projector(2)};
#endif
  return slant::solve(slant::schur_contact{problem}, f,
                      slant::residual_below(1e-8) || slant::at_most(500));
}
