// SPDX-License-Identifier: MIT
// expect: a part of A cannot be used on vectors like b.*'factorization<.*A = half
// expect-clang: a part of A cannot be used on vectors like b.*'has_plain_solve<half,
// max-lines-gcc: 20
// max-lines-clang: 35
//
// The inverse of a factorisation whose solve returns its result: the factorisation is named.
#include <slant/krylov/bicgstab.hpp>
#include <slant/operators/inverse.hpp>

#include <Eigen/Core>

struct half {
  Eigen::Index rows() const { return 2; }
#ifdef SLANT_COMPLETE
  void solve(Eigen::VectorXd const& b, Eigen::VectorXd& x) const { x = b / 2; }
#else
  Eigen::VectorXd solve(Eigen::VectorXd const& b) const { return b / 2; }
#endif
};

auto method(Eigen::VectorXd const& b) {
  return slant::bicgstab{slant::inverse(half{}), b};
}
