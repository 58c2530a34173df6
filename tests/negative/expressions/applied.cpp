// SPDX-License-Identifier: MIT
// expect: A . x: a part of A, or its adjoint, cannot be used on vectors like x
// max-lines-gcc: 22
// max-lines-clang: 40
// first: nothing
//
// y = B Bᵀx with a B that has no adjoint: said of the operator, where it is first applied.
#include <slant/operators/operators.hpp>

struct first_two {
  Eigen::Index rows() const { return 2; }
  Eigen::Index cols() const { return 3; }
  void apply(Eigen::VectorXd const& x, Eigen::VectorXd& y) const { y = x.head(2); }
#ifdef SLANT_COMPLETE
  void apply_adjoint(Eigen::VectorXd const& x, Eigen::VectorXd& y) const { y << x, 0; }
#endif
};

Eigen::VectorXd applied(Eigen::VectorXd const& x) {
  auto const B = slant::op<"B">(first_two{});
  return B * adjoint(B) * x;
}
