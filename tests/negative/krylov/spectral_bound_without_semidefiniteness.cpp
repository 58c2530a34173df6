// SPDX-License-Identifier: MIT
// expect: 'declares_positive_semidefinite['<]
// max-lines-gcc: 25
// max-lines-clang: 30
//
// The largest eigenvalue of an operator that may have negative ones of larger modulus.
#include <slant/krylov/spectral_bound.hpp>

#include <Eigen/Core>

struct twice {
#ifdef SLANT_COMPLETE
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::positive_semidefinite>;
#else
  static constexpr auto laws = slant::laws<slant::self_adjoint>;
#endif
  Eigen::Index rows() const { return 2; }
  Eigen::Index cols() const { return 2; }
  void apply(auto const& x, auto& y) const { y = 2 * x; }
};

double bound(Eigen::VectorXd const& b) {
  return slant::largest_eigenvalue_bound(twice{}, b).upper;
}
