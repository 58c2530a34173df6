// SPDX-License-Identifier: MIT
// expect: laws must be a public static constexpr slant::laws<...>
// max-lines-gcc: 20
// max-lines-clang: 45
//
// The laws as a property of each operator: the compiler could not ask for them.
#include <slant/krylov/cg.hpp>

#include <Eigen/Core>

struct twice {
#ifdef SLANT_COMPLETE
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::positive_definite>;
#else
  slant::law_set laws = slant::laws<slant::self_adjoint, slant::positive_definite>;
#endif
  Eigen::Index rows() const { return 2; }
  Eigen::Index cols() const { return 2; }
  void apply(auto const& x, auto& y) const { y = 2 * x; }
};

auto method(Eigen::VectorXd const& b) {
  return slant::cg{twice{}, b};
}
