// SPDX-License-Identifier: MIT
// expect: schur_complement: B must have apply_adjoint.*has_apply_adjoint_member
// expect-clang: schur_complement: B must have apply_adjoint.*'has_apply_adjoint_member['<]
// max-lines-gcc: 25
// max-lines-clang: 35
//
// The factor B₁ of D + B₂ K⁻¹ B₁ᵀ minus apply_adjoint.
#include <slant/operators/identity.hpp>
#include <slant/operators/schur_complement.hpp>

#include <Eigen/Core>

struct first_two {
  Eigen::Index rows() const { return 2; }
  Eigen::Index cols() const { return 3; }
  void apply(auto const& x, auto& y) const { y = x.head(2); }
#ifdef SLANT_COMPLETE
  void apply_adjoint(auto const& x, auto& y) const { y << x, 0; }
#endif
};

Eigen::MatrixXd const b2 = Eigen::MatrixXd::Zero(2, 3);
auto const s = slant::schur_complement(slant::identity_operator(3), first_two{}, b2,
                                       slant::identity_operator(2));
