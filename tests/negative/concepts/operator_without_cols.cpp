// SPDX-License-Identifier: MIT
// expect: 'has_cols['<]
// max-lines-gcc: 25
// max-lines-clang: 30
//
// An operator minus the number of its columns.
#include <slant/concepts/linear_operator.hpp>

#include <Eigen/Core>

struct twice {
  Eigen::Index rows() const { return 2; }
#ifdef SLANT_COMPLETE
  Eigen::Index cols() const { return 2; }
#endif
  void apply(auto const& x, auto& y) const { y = 2 * x; }
};

static_assert(slant::linear_operator<twice, Eigen::VectorXd>);
