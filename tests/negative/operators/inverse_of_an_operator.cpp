// SPDX-License-Identifier: MIT
// expect: knows_its_inverse
// expect-clang: 'knows_its_inverse['<]
// max-lines-gcc: 25
// max-lines-clang: 30
//
// An operator that cannot be inverted: it is no factorisation, and has no inverse().
#include <slant/operators/inverse.hpp>

#include <Eigen/Core>

struct twice {
  Eigen::Index rows() const { return 2; }
  Eigen::Index cols() const { return 2; }
  void apply(auto const& x, auto& y) const { y = 2 * x; }
#ifdef SLANT_COMPLETE
  twice inverse() const { return *this; }
#endif
};

auto const a = slant::inverse(twice{});
