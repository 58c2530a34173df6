// SPDX-License-Identifier: MIT
// expect: the set must.*has_visit
// expect-clang: the set must.*'has_visit['<]
// max-lines-gcc: 20
// max-lines-clang: 30
//
// A set that is neither a block with states nor a product of such blocks.
#include <slant/slant.hpp>

struct nonnegative {
  slant::index n;
  slant::index size() const { return n; }
  void project(auto const& x, auto& y) const { y = x.cwiseMax(0.0); }
  bool contains(auto const& x) const { return (x.array() >= 0.0).all(); }
  double step_to_boundary(auto const& x, auto const&) const { return x.minCoeff(); }
#ifdef SLANT_COMPLETE
  slant::block_state state(auto const& x) const {
    return x.minCoeff() > 0 ? slant::block_state::free : slant::block_state::fixed;
  }
#endif
};

auto solution(Eigen::VectorXd const& b) {
  auto const set = nonnegative{b.size()};
  auto const qp = slant::separable_qp{slant::identity_operator(b.size()), b, set};
  return slant::solve(slant::kprgp{qp}, b,
                      slant::reduced_gradient_below(1e-8) || slant::at_most(500));
}
