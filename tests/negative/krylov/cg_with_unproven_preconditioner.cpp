// SPDX-License-Identifier: MIT
// expect: the preconditioner must.*'declares_positive_definite['<]
// max-lines-gcc: 20
// max-lines-clang: 30
//
// A preconditioner that has not promised to be definite.
#include <slant/krylov/cg.hpp>

#include <Eigen/Core>

struct twice {
#ifdef SLANT_COMPLETE
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::positive_definite>;
#else
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::positive_semidefinite>;
#endif
  Eigen::Index rows() const { return 2; }
  Eigen::Index cols() const { return 2; }
  void apply(auto const& x, auto& y) const { y = 2 * x; }
};

auto method(Eigen::VectorXd const& b) {
  return slant::cg{slant::identity_operator(2), b, twice{}};
}
