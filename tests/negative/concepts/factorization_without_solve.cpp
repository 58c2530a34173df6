// SPDX-License-Identifier: MIT
// expect: has_plain_solve
// expect-clang: 'has_plain_solve['<]
// max-lines-gcc: 25
// max-lines-clang: 30
//
// A factorisation minus its solve.
#include <slant/slant.hpp>

struct half {
  Eigen::Index rows() const { return 2; }
#ifdef SLANT_COMPLETE
  void solve(auto const& b, auto& x) const { x = b / 2; }
#endif
};

static_assert(slant::factorization<half, Eigen::VectorXd>);
