// SPDX-License-Identifier: MIT
// expect: polyhedral_qp: K must declare.*declares_positive_semidefinite
// expect-clang: polyhedral_qp: K must declare.*'declares_positive_semidefinite['<]
// max-lines-gcc: 20
// max-lines-clang: 30
//
// A stiffness that has not promised to be semidefinite; schur_contact has nothing to add.
#include <slant/iteration/solve.hpp>
#include <slant/methods/schur_contact.hpp>

struct twice {
#ifdef SLANT_COMPLETE
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::positive_semidefinite>;
#else
  static constexpr auto laws = slant::laws<slant::self_adjoint>;
#endif
  Eigen::Index rows() const { return 2; }
  Eigen::Index cols() const { return 2; }
  void apply(auto const& x, auto& y) const { y = 2 * x; }
};

auto solution(Eigen::VectorXd const& f, slant::constraint_rows<double> const& rows) {
  auto const problem = slant::polyhedral_qp{twice{}, f, rows, slant::no_projector(2)};
  return slant::solve(slant::schur_contact{problem}, f,
                      slant::residual_below(1e-8) || slant::at_most(500));
}
