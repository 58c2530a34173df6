// SPDX-License-Identifier: MIT
// expect: range_cg: C must declare.*declares_positive_semidefinite
// expect-clang: range_cg: C must declare.*'declares_positive_semidefinite['<]
// max-lines-gcc: 20
// max-lines-clang: 30
//
// An operator C that has not promised to be semidefinite.
#include <slant/krylov/range_cg.hpp>
#include <slant/operators/identity.hpp>

#include <Eigen/Core>

struct first_entry {
#ifdef SLANT_COMPLETE
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::positive_semidefinite>;
#else
  static constexpr auto laws = slant::laws<slant::self_adjoint>;
#endif
  Eigen::Index rows() const { return 2; }
  Eigen::Index cols() const { return 2; }
  void apply(auto const& x, auto& y) const {
    y = x;
    y[1] = 0;
  }
};

auto method(Eigen::VectorXd const& b) {
  return slant::range_cg{slant::identity_operator(2), b, first_entry{}};
}
