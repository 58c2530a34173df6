// SPDX-License-Identifier: MIT
// expect: the set must.*has_step_to_boundary'
// expect-clang: the set must.*'has_step_to_boundary['<]
// max-lines-gcc: 20
// max-lines-clang: 30
//
// A set minus the step to its boundary: where would a half step end?
#include <slant/iteration/solve.hpp>
#include <slant/krylov/face_cg.hpp>
#include <slant/operators/identity.hpp>
#include <slant/sets/contact_sets.hpp>
#include <slant/sets/face.hpp>

struct nonnegative {
  slant::index n;
  slant::index size() const { return n; }
  void project(auto const& x, auto& y) const { y = x.cwiseMax(0.0); }
  bool contains(auto const& x) const { return (x.array() >= 0.0).all(); }
#ifdef SLANT_COMPLETE
  double step_to_boundary(auto const& x, auto const&) const { return x.minCoeff(); }
#endif
};

auto solution(Eigen::VectorXd const& b) {
  slant::face<double> const all(slant::free_components(2), b);
  return slant::solve(slant::cg_feas{slant::identity_operator(2), b, nonnegative{2}, all}, b,
                      slant::residual_below(1e-8) || slant::at_most(10));
}
