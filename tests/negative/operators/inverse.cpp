// SPDX-License-Identifier: MIT
// case THAT=twice WITHOUT_INVERSE: knows_its_inverse
// case THAT=twice WITHOUT_INVERSE, clang: 'knows_its_inverse['<]
// case THAT=half WITHOUT_SOLVE: has_solve_member
// case THAT=half WITHOUT_SOLVE, clang: 'has_solve_member['<]
// max-lines-gcc: 25
// max-lines-clang: 30
//
// An operator that cannot be inverted: it is no factorisation, and has no inverse(). A factorisation
// minus its solve.
#include <slant/slant.hpp>

struct twice {
  Eigen::Index rows() const { return 2; }
  Eigen::Index cols() const { return 2; }
  void apply(auto const& x, auto& y) const { y = 2 * x; }
#ifndef WITHOUT_INVERSE
  twice inverse() const { return *this; }
#endif
};

struct half {
  Eigen::Index rows() const { return 2; }
#ifndef WITHOUT_SOLVE
  void solve(auto const& b, auto& x) const { x = b / 2; }
#endif
};

auto const a = slant::inverse(THAT{});
