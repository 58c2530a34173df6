// SPDX-License-Identifier: MIT
// expect: 'has_rows['<]
// max-lines-gcc: 25
// max-lines-clang: 30
//
// An operator minus the number of its rows.
#include <slant/concepts/linear_operator.hpp>

#include <Eigen/Core>

struct twice {
#ifdef SLANT_COMPLETE
  Eigen::Index rows() const { return 2; }
#endif
  Eigen::Index cols() const { return 2; }
  void apply(auto const& x, auto& y) const { y = 2 * x; }
};

static_assert(slant::linear_operator<twice, Eigen::VectorXd>);
