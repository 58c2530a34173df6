// SPDX-License-Identifier: MIT
// expect: A must.*has_plain_apply
// expect-clang: A must.*'has_plain_apply['<]
// max-lines-gcc: 20
// max-lines-clang: 30
//
// The operator of a quadratic program whose apply is misspelt.
#include <slant/iteration/solve.hpp>
#include <slant/methods/kprgp.hpp>
#include <slant/sets/contact_sets.hpp>

struct twice {
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::positive_semidefinite>;
  Eigen::Index rows() const { return 2; }
  Eigen::Index cols() const { return 2; }
#ifdef SLANT_COMPLETE
  void apply(auto const& x, auto& y) const { y = 2 * x; }
#else
  void aply(auto const& x, auto& y) const { y = 2 * x; }
#endif
};

auto solution(Eigen::VectorXd const& b) {
  auto const set = slant::half_lines(b.size());
  auto const qp = slant::separable_qp{twice{}, b, set};
  return slant::solve(slant::kprgp{qp}, b,
                      slant::reduced_gradient_below(1e-8) || slant::at_most(500));
}
