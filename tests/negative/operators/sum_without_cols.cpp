// SPDX-License-Identifier: MIT
// expect: a term or factor must be an operator.*'has_cols['<]
// max-lines-gcc: 25
// max-lines-clang: 30
//
// A term minus the number of its columns.
#include <slant/operators/identity.hpp>
#include <slant/operators/sum.hpp>

#include <Eigen/Core>

struct twice {
  Eigen::Index rows() const { return 2; }
#ifdef SLANT_COMPLETE
  Eigen::Index cols() const { return 2; }
#endif
  void apply(auto const& x, auto& y) const { y = 2 * x; }
};

auto const a = slant::sum(slant::identity_operator(2), twice{});
