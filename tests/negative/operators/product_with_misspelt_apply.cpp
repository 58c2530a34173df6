// SPDX-License-Identifier: MIT
// expect: a term or factor must be an operator.*has_apply_member
// expect-clang: a term or factor must be an operator.*'has_apply_member['<]
// max-lines-gcc: 25
// max-lines-clang: 30
//
// The right factor of a product minus apply: noticed where the product is made.
#include <slant/operators/identity.hpp>
#include <slant/operators/product.hpp>

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

auto const a = slant::product(slant::identity_operator(2), twice{});
