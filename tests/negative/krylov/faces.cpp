// SPDX-License-Identifier: MIT
// case USE=half_step WITHOUT_STEP: the set must.*has_step_to_boundary'
// case USE=half_step WITHOUT_STEP, clang: the set must.*'has_step_to_boundary['<]
// case USE=on_face WITHOUT_KEEP: the face must.*has_keep
// case USE=on_face WITHOUT_KEEP, clang: the face must.*'has_keep['<]
// case USE=projected WITHOUT_MINIMISER: range_cg: Q must have add_minimiser
// max-lines-gcc: 20
// max-lines-clang: 30
//
// A set minus the step to its boundary, where a half step would end; a face minus keep, which keeps the
// directions on it; a projector minus the minimum over what it projects along.
#include <slant/iteration/solve.hpp>
#include <slant/krylov/face_cg.hpp>
#include <slant/krylov/range_cg.hpp>
#include <slant/operators/identity.hpp>
#include <slant/sets/contact_sets.hpp>
#include <slant/sets/face.hpp>

struct nonnegative {
  slant::index n;
  slant::index size() const { return n; }
  void project(auto const& x, auto& y) const { y = x.cwiseMax(0.0); }
  bool contains(auto const& x) const { return (x.array() >= 0.0).all(); }
#ifndef WITHOUT_STEP
  double step_to_boundary(auto const& x, auto const&) const { return x.minCoeff(); }
#endif
};

struct without_first {
  Eigen::Index rows() const { return 2; }
  Eigen::Index cols() const { return 2; }
  void apply(auto const& x, auto& y) const {
    y = x;
    y[0] = 0;
  }
#ifndef WITHOUT_KEEP
  void keep(auto const& x, auto& y) const { apply(x, y); }
#endif
#ifndef WITHOUT_MINIMISER
  void add_minimiser(double a, auto const& b, auto& y, auto&) const { y[0] += a * b[0]; }
#endif
};

slant::identity_operator const one(2);
auto half_step(auto const& b) {
  slant::face<double> const all(slant::free_components(2), b);
  return slant::solve(slant::cg_feas{one, b, nonnegative{2}, all}, b,
                      slant::residual_below(1e-8) || slant::at_most(10));
}
auto on_face(auto const& b) {
  return slant::face_cg{one, b, without_first{}};
}
auto projected(auto const& b) {
  return slant::range_cg{one, b, one, without_first{}};
}

auto use(Eigen::VectorXd const& b) {
  return USE(b);
}
