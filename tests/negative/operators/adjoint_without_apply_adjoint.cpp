// SPDX-License-Identifier: MIT
// expect: has_apply_adjoint_member
// expect-clang: 'has_apply_adjoint_member['<]
// max-lines-gcc: 25
// max-lines-clang: 30
//
// An operator minus apply_adjoint: nobody knows its adjoint.
#include <slant/operators/letter.hpp>

#include <Eigen/Core>

struct first_two {
  Eigen::Index rows() const { return 2; }
  Eigen::Index cols() const { return 3; }
  void apply(auto const& x, auto& y) const { y = x.head(2); }
#ifdef SLANT_COMPLETE
  void apply_adjoint(auto const& x, auto& y) const { y << x, 0; }
#endif
};

auto const a = slant::adjoint(first_two{});
