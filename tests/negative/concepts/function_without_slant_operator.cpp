// SPDX-License-Identifier: MIT
// expect: 'has_slant_operator['<]
// max-lines-gcc: 25
// max-lines-clang: 30
//
// A slanting function whose F°(y) is a matrix, and not an operator that could be applied.
#include <slant/slant.hpp>

struct twice {
  Eigen::Index rows() const { return 2; }
  Eigen::Index cols() const { return 2; }
  void apply(auto const& x, auto& y) const { y = 2 * x; }
};

struct doubling {
  Eigen::Index rows() const { return 2; }
  Eigen::Index cols() const { return 2; }
  void value(auto const& y, auto& f) const { f = 2 * y; }
#ifdef SLANT_COMPLETE
  twice slant(auto const&) const { return {}; }
#else
  Eigen::Matrix2d slant(auto const&) const { return 2 * Eigen::Matrix2d::Identity(); }
#endif
};

static_assert(slant::slanting_function<doubling, Eigen::VectorXd>);
