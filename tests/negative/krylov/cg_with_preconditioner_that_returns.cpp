// SPDX-License-Identifier: MIT
// expect: the preconditioner must be a linear operator on vectors like b.*has_plain_apply
// max-lines-gcc: 20
// max-lines-clang: 32
//
// A preconditioner that returns its result instead of writing it.
#include <slant/krylov/cg.hpp>

#include <Eigen/Core>

struct half {
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::positive_definite>;
  Eigen::Index rows() const { return 2; }
  Eigen::Index cols() const { return 2; }
#ifdef SLANT_COMPLETE
  void apply(Eigen::VectorXd const& x, Eigen::VectorXd& y) const { y = x / 2; }
#else
  Eigen::VectorXd apply(Eigen::VectorXd const& x) const { return x / 2; }
#endif
};

auto method(Eigen::VectorXd const& b) {
  return slant::cg{slant::identity_operator(2), b, half{}};
}
