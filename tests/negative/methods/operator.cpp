// SPDX-License-Identifier: MIT
// case SOLVER=kprgp WITHOUT_LAWS: A must declare.*'declares_self_adjoint['<]
// case SOLVER=imssn WITHOUT_LAWS: A must declare.*'declares_self_adjoint['<]
// case SOLVER=kprgp WITHOUT_SEMIDEFINITENESS: A must declare.*'declares_positive_semidefinite['<]
// case SOLVER=qpc WITHOUT_SEMIDEFINITENESS: A must declare.*'declares_positive_semidefinite['<]
// case SOLVER=kprgp WITHOUT_COLS: A must.*'has_cols['<]
// case SOLVER=kprgp MISSPELT_APPLY: A must.*has_plain_apply
// case SOLVER=kprgp MISSPELT_APPLY, clang: A must.*'has_plain_apply['<]
// case SOLVER=kprgp GIVEN_AN_OPERATOR: expected a separable_qp.*'has_hessian['<]
// case SOLVER=mssn GIVEN_AN_OPERATOR: expected a separable_qp.*'has_hessian['<]
// case SOLVER=kprgp GIVEN_A_POLYHEDRAL_QP: expected a separable_qp.*'has_hessian['<]
// max-lines-gcc: 20
// max-lines-clang: 30
//
// The operator of a quadratic program minus its laws, by which nobody has promised that
// q(x) = ½ xᵀA x − bᵀx is convex, minus its columns, or with a misspelt apply; the operator alone
// instead of the program; a problem of another kind, which has vectors and a scalar as well. An
// observer may add nothing to the complaint.
#include <slant/slant.hpp>

struct twice {
#if defined(WITHOUT_SEMIDEFINITENESS)
  static constexpr auto laws = slant::laws<slant::self_adjoint>;
#elif !defined(WITHOUT_LAWS)
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::positive_semidefinite>;
#endif
  Eigen::Index rows() const { return 2; }
#ifndef WITHOUT_COLS
  Eigen::Index cols() const { return 2; }
#endif
#ifdef MISSPELT_APPLY
  void aply(auto const& x, auto& y) const { y = 2 * x; }
#else
  void apply(auto const& x, auto& y) const { y = 2 * x; }
#endif
};

auto solution(Eigen::VectorXd const& b, slant::constraint_rows<double> const& rows) {
#if defined(GIVEN_AN_OPERATOR)
  auto const qp = twice{};
#elif defined(GIVEN_A_POLYHEDRAL_QP)
  auto const qp = slant::polyhedral_qp{twice{}, b, rows, slant::no_projector(b.size())};
#else
  auto const set = slant::half_lines(rows.count());
  auto const qp = slant::separable_qp{twice{}, b, set};
#endif
  slant::history accuracy([](auto const& s) { return s.reduced_gradient_norm; });
  return slant::solve(slant::SOLVER{qp}, b,
                      slant::reduced_gradient_below(1e-8) || slant::at_most(500), accuracy);
}
