// SPDX-License-Identifier: MIT
// expect: a part of A cannot be used on vectors like b.*'has_adjoint<.*A = first_two
// expect-clang: a part of A cannot be used on vectors like b.*'has_plain_adjoint<first_two,
// max-lines-gcc: 20
// max-lines-clang: 40
//
// B A Bᵀ where the adjoint of B returns its result: B is named, not the composition.
#include <slant/krylov/cg.hpp>
#include <slant/operators/product.hpp>

#include <Eigen/Core>

struct first_two {
  Eigen::Index rows() const { return 2; }
  Eigen::Index cols() const { return 3; }
  void apply(Eigen::VectorXd const& x, Eigen::VectorXd& y) const { y = x.head(2); }
#ifdef SLANT_COMPLETE
  void apply_adjoint(Eigen::VectorXd const& x, Eigen::VectorXd& y) const { y << x, 0; }
#else
  Eigen::VectorXd apply_adjoint(Eigen::VectorXd const& x) const {
    return Eigen::Vector3d(x[0], x[1], 0);
  }
#endif
};

auto method(Eigen::VectorXd const& b) {
  return slant::cg{
      slant::congruence(slant::full_row_rank(first_two{}), slant::identity_operator(3)), b};
}
