// SPDX-License-Identifier: MIT
// case WITHOUT_SELF_ADJOINTNESS: A must.*'declares_self_adjoint['<]
// case USE=solved WITHOUT_DEFINITENESS: A must.*'declares_positive_definite['<]
// case APPLY_OF_OTHER_SCALAR: A must be a linear operator on vectors like b.*has_plain_apply
// case APPLY_OF_OTHER_SCALAR, max-lines-clang: 32
// case USE=cg_after WITHOUT_DEFINITENESS: the preconditioner must.*'declares_positive_definite['<]
// case USE=cg_after RETURNING_APPLY: the preconditioner must be a linear operator on vectors like b.*has_plain_apply
// case USE=cg_after RETURNING_APPLY, max-lines-clang: 32
// case USE=bicgstab_of WITHOUT_ROWS: A must.*'has_rows['<]
// case USE=range_of WITHOUT_SEMIDEFINITENESS: range_cg: C must declare.*declares_positive_semidefinite
// case USE=range_of WITHOUT_SEMIDEFINITENESS, clang: range_cg: C must declare.*'declares_positive_semidefinite['<]
// case USE=bound_of WITHOUT_SEMIDEFINITENESS: 'declares_positive_semidefinite['<]
// case USE=bound_of WITHOUT_SEMIDEFINITENESS, max-lines-gcc: 25
// max-lines-gcc: 20
// max-lines-clang: 30
//
// An operator minus one of its promises, as those of semismooth Newton methods lack symmetry; minus its
// rows; on vectors of float, where its laws are not to blame; or that returns its result instead of
// writing it. Conjugate gradients with it and with it as preconditioner, and its largest eigenvalue,
// beside which there may be negative ones of larger modulus.
#include <slant/slant.hpp>

struct twice {
#if defined(WITHOUT_SELF_ADJOINTNESS)
  static constexpr auto laws = slant::laws<slant::positive_definite>;
#elif defined(WITHOUT_SEMIDEFINITENESS)
  static constexpr auto laws = slant::laws<slant::self_adjoint>;
#elif defined(WITHOUT_DEFINITENESS)
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::positive_semidefinite>;
#else
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::positive_definite>;
#endif
#ifndef WITHOUT_ROWS
  Eigen::Index rows() const { return 2; }
#endif
  Eigen::Index cols() const { return 2; }
#if defined(APPLY_OF_OTHER_SCALAR)
  void apply(Eigen::VectorXf const& x, Eigen::VectorXf& y) const { y = 2 * x; }
#elif defined(RETURNING_APPLY)
  Eigen::VectorXd apply(Eigen::VectorXd const& x) const { return 2 * x; }
#else
  void apply(Eigen::VectorXd const& x, Eigen::VectorXd& y) const { y = 2 * x; }
#endif
};

auto solved(auto const& A, Eigen::VectorXd const& b) {
  return slant::solve(slant::cg{A, b}, b, slant::residual_below(1e-8) || slant::at_most(9));
}
auto cg_after(auto const& M, Eigen::VectorXd const& b) {
  return slant::cg{slant::identity_operator(2), b, M};
}
auto bicgstab_of(auto const& A, Eigen::VectorXd const& b) {
  return slant::bicgstab{A, b};
}
auto range_of(auto const& C, Eigen::VectorXd const& b) {
  return slant::range_cg{slant::identity_operator(2), b, C};
}
auto bound_of(auto const& A, Eigen::VectorXd const& b) {
  return slant::largest_eigenvalue_bound(A, b).upper;
}

auto method(Eigen::VectorXd const& b) {
#ifdef USE
  return USE(twice{}, b);
#else
  return slant::cg{twice{}, b};
#endif
}
