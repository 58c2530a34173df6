// SPDX-License-Identifier: MIT
// expect: range_cg: Q must have add_minimiser
// max-lines-gcc: 20
// max-lines-clang: 30
//
// A projector minus the minimum over what it projects along.
#include <slant/slant.hpp>

struct without_first {
  Eigen::Index rows() const { return 2; }
  Eigen::Index cols() const { return 2; }
  void apply(auto const& x, auto& y) const {
    y = x;
    y[0] = 0;
  }
#ifdef SLANT_COMPLETE
  void add_minimiser(double a, auto const& b, auto& y, auto&) const { y[0] += a * b[0]; }
#endif
};

slant::identity_operator const one(2);

auto use(Eigen::VectorXd const& b) {
  return slant::range_cg{one, b, one, without_first{}};
}
