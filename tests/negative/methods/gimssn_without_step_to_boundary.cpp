// SPDX-License-Identifier: MIT
// expect: the set must.*'has_step_to_boundary['<]
// max-lines-gcc: 20
// max-lines-clang: 30
//
// The blocks of the set minus the step to their boundary.
#include <slant/iteration/solve.hpp>
#include <slant/methods/mssn.hpp>
#include <slant/operators/identity.hpp>
#include <slant/sets/power.hpp>

struct upper_half_plane {
  static constexpr int dimension = 2;
  Eigen::Vector2d project(auto const& x) const { return {x[0], x[1] < 0 ? 0 : x[1]}; }
  bool contains(auto const& x) const { return x[1] >= 0; }
  slant::block_state state(auto const& x) const {
    return x[1] > 0 ? slant::block_state::free : slant::block_state::sliding;
  }
#ifdef SLANT_COMPLETE
  double step_to_boundary(auto const& x, auto const& d) const { return -x[1] / d[1]; }
#endif
};

auto solution(Eigen::VectorXd const& b) {
  auto const set = slant::power(upper_half_plane{}, b.size() / 2);
  auto const qp = slant::separable_qp{slant::identity_operator(b.size()), b, set};
  return slant::solve(slant::gimssn{qp}, b,
                      slant::reduced_gradient_below(1e-8) || slant::at_most(500));
}
