// SPDX-License-Identifier: MIT
// expect: has_plain_apply
// expect-clang: 'has_plain_apply['<]
// max-lines-gcc: 25
// max-lines-clang: 30
//
// An operator that is not const while it is applied: two threads could not share it.
#include <slant/concepts/linear_operator.hpp>

#include <Eigen/Core>

struct counting {
  Eigen::Index rows() const { return 2; }
  Eigen::Index cols() const { return 2; }
#ifdef SLANT_COMPLETE
  void apply(auto const& x, auto& y) const { y = x; }
#else
  void apply(auto const& x, auto& y) {
    ++applications;
    y = x;
  }
#endif
  int applications = 0;
};

static_assert(slant::linear_operator<counting, Eigen::VectorXd>);
