// SPDX-License-Identifier: MIT
// case SOLVER=interior_point WITHOUT_LAWS: the preconditioner must declare self_adjoint
// case SOLVER=symmetric_newton WITHOUT_LAWS: the preconditioner must declare self_adjoint
// max-lines-gcc: 20
// max-lines-clang: 30
//
// A preconditioner minus its promise to be self-adjoint and semidefinite.
#include <slant/slant.hpp>

struct smoother {
#ifndef WITHOUT_LAWS
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::positive_definite>;
#endif
  Eigen::Index n;
  Eigen::Index rows() const { return n; }
  Eigen::Index cols() const { return n; }
  void apply(auto const& x, auto& y) const { y = 0.5 * x; }
};

auto solution(Eigen::VectorXd const& b) {
  auto const qp =
      slant::separable_qp{slant::identity_operator(b.size()), b, slant::half_lines(b.size())};
  return slant::solve(slant::SOLVER{qp, smoother{b.size()}}, b,
                      slant::reduced_gradient_below(1e-8) || slant::at_most(500));
}
