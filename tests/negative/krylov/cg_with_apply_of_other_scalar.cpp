// SPDX-License-Identifier: MIT
// expect: A must be a linear operator on vectors like b.*has_plain_apply
// max-lines-gcc: 20
// max-lines-clang: 32
//
// An operator that promises all that is asked, but on vectors of float: its laws are not to blame.
#include <slant/krylov/cg.hpp>

#include <Eigen/Core>

struct twice {
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::positive_definite>;
  Eigen::Index rows() const { return 2; }
  Eigen::Index cols() const { return 2; }
#ifdef SLANT_COMPLETE
  void apply(Eigen::VectorXd const& x, Eigen::VectorXd& y) const { y = 2 * x; }
#else
  void apply(Eigen::VectorXf const& x, Eigen::VectorXf& y) const { y = 2 * x; }
#endif
};

auto method(Eigen::VectorXd const& b) {
  return slant::cg{twice{}, b};
}
