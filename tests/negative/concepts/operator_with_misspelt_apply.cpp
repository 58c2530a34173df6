// SPDX-License-Identifier: MIT
// expect: has_plain_apply
// expect-clang: 'has_plain_apply['<]
// max-lines-gcc: 25
// max-lines-clang: 30
//
// An operator whose apply is misspelt.
#include <slant/concepts/linear_operator.hpp>

#include <Eigen/Core>

struct twice {
  Eigen::Index rows() const { return 2; }
  Eigen::Index cols() const { return 2; }
#ifdef SLANT_COMPLETE
  void apply(auto const& x, auto& y) const { y = 2 * x; }
#else
  void aply(auto const& x, auto& y) const { y = 2 * x; }
#endif
};

static_assert(slant::linear_operator<twice, Eigen::VectorXd>);
