// SPDX-License-Identifier: MIT
// case USE=product WITHOUT_PROJECT: has_project
// case USE=product WITHOUT_PROJECT, max-lines-gcc: 25
// case USE=product WITHOUT_PROJECT, max-lines-clang: 37
// case USE=power WITHOUT_CONTAINS: power: the shape must be a convex set or function of fixed dimension.*has_contains
// case USE=power WITHOUT_DIMENSION: power: the shape must be a convex set or function of fixed dimension.*has_static_dimension
// case USE=power WITHOUT_DIMENSION, max-lines-clang: 25
// case USE=face WITHOUT_STATE: a block of this set has no state.x., so its points have no face
// case USE=face WITHOUT_STATE, max-lines-gcc: 25
// case USE=face WITHOUT_STATE, max-lines-clang: 35
// case USE=derivative WITHOUT_SLANT: all_slant
// case USE=derivative WITHOUT_SLANT, max-lines-gcc: 25
// case USE=step WITHOUT_STEP: has_step_to_boundary
// case USE=step WITHOUT_STEP, max-lines-gcc: 25
// case USE=projection WITHOUT_SLANT: 'has_slant_member['<]
// case USE=projection WITHOUT_SLANT, max-lines-gcc: 25
// case USE=residual WITHOUT_SLANT: 'has_projection_slant['<]
// case USE=residual WITHOUT_SLANT, max-lines-gcc: 25
// case USE=conditions WITHOUT_INEQUALITY: every block of the set must have a smooth inequality form
// case USE=conditions WITHOUT_INEQUALITY, max-lines-gcc: 40
// case USE=conditions WITHOUT_INEQUALITY, max-lines-clang: 40
// case USE=solved SOLVER=kprgp WITHOUT_STATE: the set must.*'has_block_states['<]
// case USE=solved SOLVER=qpq WITHOUT_STATE: the set must.*'has_block_states['<]
// case USE=solved SOLVER=kprgp WITHOUT_STEP: the set must.*'has_step_to_boundary['<]
// case USE=solved SOLVER=gimssn WITHOUT_STEP: the set must.*'has_step_to_boundary['<]
// case USE=solved SOLVER=symmetric_newton WITHOUT_SLANT: made of blocks with slant\(x\), state\(x\) and step_to_boundary
// case USE=solved SOLVER=symmetric_newton WITHOUT_STATE: made of blocks with slant\(x\), state\(x\) and step_to_boundary
// case USE=solved SOLVER=interior_point WITHOUT_INEQUALITY: the set must be made of blocks with a smooth inequality form
// max-lines-gcc: 20
// max-lines-clang: 30
//
// A block minus one thing, and what is made of it: without a dimension a power could not know where
// the next block begins; a product has a slanting operator and steps if its parts have them; functions
// and methods ask for the slanting operator of its projection, a smooth inequality form, the state of
// its points, by which a face is known, and the step to its boundary.
#include <slant/slant.hpp>

struct upper_half_plane {
#ifndef WITHOUT_DIMENSION
  static constexpr int dimension = 2;
#endif
#ifndef WITHOUT_PROJECT
  Eigen::Vector2d project(auto const& x) const { return {x[0], x[1] < 0 ? 0 : x[1]}; }
#endif
#ifndef WITHOUT_CONTAINS
  bool contains(auto const& x) const { return x[1] >= 0; }
#endif
#ifndef WITHOUT_STATE
  slant::block_state state(auto const& x) const {
    return x[1] > 0 ? slant::block_state::free : slant::block_state::sliding;
  }
#endif
#ifndef WITHOUT_SLANT
  Eigen::Matrix2d slant(auto const& x) const {
    return Eigen::Vector2d(1, x[1] < 0 ? 0 : 1).asDiagonal();
  }
#endif
#ifndef WITHOUT_STEP
  double step_to_boundary(auto const& x, auto const& d) const { return -x[1] / d[1]; }
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

auto product(auto const& block, auto const&, auto const&) {
  return slant::cartesian(slant::half_line<>{}, block);
}
auto power(auto const& block, auto const&, auto const&) {
  return slant::power(block, 3);
}
auto face(auto const& block, auto const&, auto const& x) {
  return slant::face_of(slant::power(block, 3), x);
}
auto derivative(auto const& block, auto const&, auto const& x) {
  return slant::cartesian(slant::half_line<>{}, block).slant(x.head(3).eval());
}
auto step(auto const& block, auto const&, auto const& x) {
  return slant::power(block, 3).step_to_boundary(x, x);
}
auto projection(auto const& block, auto const&, auto const&) {
  return slant::projection(block);
}
auto residual(auto const& block, auto const& A, auto const& b) {
  return slant::natural_residual(A, b, slant::power(block, 3), 0.5);
}
auto conditions(auto const& block, auto const& A, auto const& b) {
  return slant::kkt(A, b, slant::power(block, 3), 0.5);
}
#ifdef SOLVER
auto solved(auto const& block, auto const&, auto const& b) {
  auto const set = slant::power(block, b.size() / 2);
  auto const qp = slant::separable_qp{slant::identity_operator(b.size()), b, set};
  return slant::solve(slant::SOLVER{qp}, b,
                      slant::reduced_gradient_below(1e-8) || slant::at_most(500));
}
#endif

auto use(Eigen::MatrixXd const& A, Eigen::VectorXd const& x) {
  return USE(upper_half_plane{}, A, x);
}
