// SPDX-License-Identifier: MIT
// expect: A must.*'declares_positive_definite['<]
// max-lines-gcc: 20
// max-lines-clang: 30
//
// An operator that is only semidefinite: conjugate gradients may divide by zero.
#include <slant/iteration/solve.hpp>
#include <slant/krylov/cg.hpp>

#include <Eigen/Core>

struct twice {
#ifdef SLANT_COMPLETE
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::positive_definite>;
#else
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::positive_semidefinite>;
#endif
  Eigen::Index rows() const { return 2; }
  Eigen::Index cols() const { return 2; }
  void apply(auto const& x, auto& y) const { y = 2 * x; }
};

auto solution(Eigen::VectorXd const& b) {
  return slant::solve(slant::cg{twice{}, b}, b, slant::residual_below(1e-8) || slant::at_most(9));
}
