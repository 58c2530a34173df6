// SPDX-License-Identifier: MIT
// case METHOD=kprgp WITHOUT_STATE: the set must.*'has_block_states['<]
// case METHOD=qpq WITHOUT_STATE: the set must.*'has_block_states['<]
// case METHOD=kprgp WITHOUT_STEP: the set must.*'has_step_to_boundary['<]
// case METHOD=gimssn WITHOUT_STEP: the set must.*'has_step_to_boundary['<]
// case METHOD=symmetric_newton WITHOUT_SLANT: the set must be made of blocks with slant\(x\)
// case METHOD=interior_point WITHOUT_INEQUALITY: the set must be made of blocks with a smooth inequality form
// max-lines-gcc: 20
// max-lines-clang: 30
//
// The blocks of the set minus the state of their points, so that no face is known, the step to their
// boundary, the slanting operator of their projection, or a smooth inequality form.
#include <slant/iteration/solve.hpp>
#include <slant/methods/interior_point.hpp>
#include <slant/methods/kprgp.hpp>
#include <slant/methods/mssn.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/operators/identity.hpp>
#include <slant/sets/power.hpp>

struct upper_half_plane {
  static constexpr int dimension = 2;
  Eigen::Vector2d project(auto const& x) const { return {x[0], x[1] < 0 ? 0 : x[1]}; }
  bool contains(auto const& x) const { return x[1] >= 0; }
#ifndef WITHOUT_STATE
  slant::block_state state(auto const& x) const {
    return x[1] > 0 ? slant::block_state::free : slant::block_state::sliding;
  }
#endif
#ifndef WITHOUT_STEP
  double step_to_boundary(auto const& x, auto const& d) const {
    return d[1] < 0 ? -x[1] / d[1] : 1 / 0.0;
  }
#endif
#ifndef WITHOUT_SLANT
  Eigen::Matrix2d slant(auto const& x) const {
    return Eigen::Vector2d(1, x[1] < 0 ? 0 : 1).asDiagonal();
  }
#endif
#ifndef WITHOUT_INEQUALITY
  static constexpr int inequalities = 1;
  Eigen::Matrix<double, 1, 1> inequality(auto const& x) const {
    return Eigen::Matrix<double, 1, 1>::Constant(-x[1]);
  }
  Eigen::Vector2d inequality_gradient(auto const&) const { return {0, -1}; }
  Eigen::Matrix2d inequality_hessian(auto const&, auto const&) const {
    return Eigen::Matrix2d::Zero();
  }
#endif
};

auto solution(Eigen::VectorXd const& b) {
  auto const set = slant::power(upper_half_plane{}, b.size() / 2);
  auto const qp = slant::separable_qp{slant::identity_operator(b.size()), b, set};
  return slant::solve(slant::METHOD{qp}, b,
                      slant::reduced_gradient_below(1e-8) || slant::at_most(500));
}
