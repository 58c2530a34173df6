// SPDX-License-Identifier: MIT
// expect: congruence: B must have apply_adjoint.*has_apply_adjoint_member
// expect-clang: 'has_apply_adjoint_member['<]
// max-lines-gcc: 20
// max-lines-clang: 35
//
// The outer factor of B A Bᵀ minus apply_adjoint.
#include <slant/operators/identity.hpp>
#include <slant/operators/product.hpp>

#include <Eigen/Core>

struct first_two {
  Eigen::Index rows() const { return 2; }
  Eigen::Index cols() const { return 3; }
  void apply(auto const& x, auto& y) const { y = x.head(2); }
#ifdef SLANT_COMPLETE
  void apply_adjoint(auto const& x, auto& y) const { y << x, 0; }
#endif
};

auto const a = slant::congruence(first_two{}, slant::identity_operator(3));
