// SPDX-License-Identifier: MIT
// expect: A must.*'declares_self_adjoint['<]
// max-lines-gcc: 20
// max-lines-clang: 30
//
// A definite operator that is not symmetric, as those of semismooth Newton methods.
#include <slant/krylov/cg.hpp>

#include <Eigen/Core>

struct twice {
#ifdef SLANT_COMPLETE
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::positive_definite>;
#else
  static constexpr auto laws = slant::laws<slant::positive_definite>;
#endif
  Eigen::Index rows() const { return 2; }
  Eigen::Index cols() const { return 2; }
  void apply(auto const& x, auto& y) const { y = 2 * x; }
};

auto method(Eigen::VectorXd const& b) {
  return slant::cg{twice{}, b};
}
