// SPDX-License-Identifier: MIT
// case USE=turned WITHOUT_ADJOINT: has_apply_adjoint_member
// case USE=turned WITHOUT_ADJOINT, clang: 'has_apply_adjoint_member['<]
// case USE=turned WITHOUT_ADJOINT, max-lines-clang: 34
// case USE=congruent WITHOUT_ADJOINT: congruence: B must have apply_adjoint.*has_apply_adjoint_member
// case USE=congruent WITHOUT_ADJOINT, clang: 'has_apply_adjoint_member['<]
// case USE=congruent WITHOUT_ADJOINT, max-lines-gcc: 20
// case USE=complement WITHOUT_ADJOINT: schur_complement: B must have apply_adjoint.*has_apply_adjoint_member
// case USE=complement WITHOUT_ADJOINT, clang: schur_complement: B must have apply_adjoint.*'has_apply_adjoint_member['<]
// max-lines-gcc: 25
// max-lines-clang: 35
//
// An operator minus apply_adjoint, so that nobody knows its adjoint; as the outer factor of B A Bᵀ, and
// as B₁ of D + B₂ K⁻¹ B₁ᵀ.
#include <slant/slant.hpp>

struct first_two {
  Eigen::Index rows() const { return 2; }
  Eigen::Index cols() const { return 3; }
  void apply(auto const& x, auto& y) const { y = x.head(2); }
#ifndef WITHOUT_ADJOINT
  void apply_adjoint(auto const& x, auto& y) const { y << x, 0; }
#endif
};

slant::identity_operator const one(3), D(2);
Eigen::MatrixXd const b2 = Eigen::MatrixXd::Zero(2, 3);

auto turned(auto const& B) {
  return slant::adjoint(B);
}
auto congruent(auto const& B) {
  return slant::congruence(B, one);
}
auto complement(auto const& B) {
  return slant::schur_complement(one, B, b2, D);
}

auto const a = USE(first_two{});
