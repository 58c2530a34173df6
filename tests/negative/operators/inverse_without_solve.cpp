// SPDX-License-Identifier: MIT
// expect: has_solve_member
// expect-clang: 'has_solve_member['<]
// max-lines-gcc: 25
// max-lines-clang: 30
//
// A factorisation minus its solve.
#include <slant/operators/inverse.hpp>

#include <Eigen/Core>

struct half {
  Eigen::Index rows() const { return 2; }
#ifdef SLANT_COMPLETE
  void solve(auto const& b, auto& x) const { x = b / 2; }
#endif
};

auto const a = slant::inverse(half{});
