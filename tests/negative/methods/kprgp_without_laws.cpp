// SPDX-License-Identifier: MIT
// expect: A must declare.*'declares_self_adjoint['<]
// max-lines-gcc: 20
// max-lines-clang: 30
//
// An operator minus its laws: nobody has promised that q(x) = ½ xᵀA x − bᵀx is convex.
#include <slant/iteration/solve.hpp>
#include <slant/methods/kprgp.hpp>
#include <slant/sets/contact_sets.hpp>

struct twice {
#ifdef SLANT_COMPLETE
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::positive_semidefinite>;
#endif
  Eigen::Index rows() const { return 2; }
  Eigen::Index cols() const { return 2; }
  void apply(auto const& x, auto& y) const { y = 2 * x; }
};

auto solution(Eigen::VectorXd const& b) {
  auto const set = slant::half_lines(b.size());
  auto const qp = slant::separable_qp{twice{}, b, set};
  return slant::solve(slant::kprgp{qp}, b,
                      slant::reduced_gradient_below(1e-8) || slant::at_most(500));
}
