// SPDX-License-Identifier: MIT
// expect: A must declare.*'declares_positive_semidefinite['<]
// expect-clang: A must declare
// max-lines-gcc: 20
// max-lines-clang: 30
//
// An operator that promises to be self-adjoint and not that q(x) = ½ xᵀA x − bᵀx is convex.
#include <slant/iteration/solve.hpp>
#include <slant/methods/smalse.hpp>
#include <slant/problems/equality_constraints.hpp>
#include <slant/sets/contact_sets.hpp>

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

auto solution(Eigen::VectorXd const& b, slant::equality_constraints<double> const& constraints) {
  auto const set = slant::half_lines(b.size());
  auto const qp = slant::separable_qp{twice{}, b, set};
  return slant::solve(slant::smalse{qp, constraints}, b,
                      slant::reduced_gradient_below(1e-8) || slant::at_most(500));
}
