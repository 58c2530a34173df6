// SPDX-License-Identifier: MIT
// expect: the set must.*'has_project['<]
// max-lines-gcc: 20
// max-lines-clang: 35
//
// A set minus its projection.
#include <slant/operators/identity.hpp>
#include <slant/problems/separable_qp.hpp>

#include <Eigen/Core>

struct nonnegative {
  slant::index n;
  slant::index size() const { return n; }
#ifdef SLANT_COMPLETE
  void project(auto const& x, auto& y) const { y = x.cwiseMax(0.0); }
#endif
  bool contains(auto const& x) const { return (x.array() >= 0.0).all(); }
};

auto problem(Eigen::VectorXd const& b) {
  return slant::separable_qp{slant::identity_operator(b.size()), b, nonnegative{b.size()}};
}
