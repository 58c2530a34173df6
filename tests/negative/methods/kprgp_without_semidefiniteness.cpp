// SPDX-License-Identifier: MIT
// expect: A must declare.*'declares_positive_semidefinite['<]
// max-lines-gcc: 20
// max-lines-clang: 30
//
// A self-adjoint operator that has not promised to be semidefinite.
#include <slant/iteration/solve.hpp>
#include <slant/methods/kprgp.hpp>
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

auto solution(Eigen::VectorXd const& b) {
  auto const set = slant::half_lines(b.size());
  auto const qp = slant::separable_qp{twice{}, b, set};
  return slant::solve(slant::kprgp{qp}, b,
                      slant::reduced_gradient_below(1e-8) || slant::at_most(500));
}
