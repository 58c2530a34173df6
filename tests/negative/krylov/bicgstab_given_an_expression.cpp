// SPDX-License-Identifier: MIT
// expect: b must be a slant::vector.*'owns_its_entries['<]
// max-lines-gcc: 25
// max-lines-clang: 30
//
// A right-hand side that is an expression: it has no entries of its own.
#include <slant/krylov/bicgstab.hpp>
#include <slant/operators/identity.hpp>

#include <Eigen/Core>

auto method(Eigen::VectorXd const& b) {
#ifdef SLANT_COMPLETE
  return slant::bicgstab{slant::identity_operator(2), Eigen::VectorXd(-b)};
#else
  return slant::bicgstab{slant::identity_operator(2), -b};
#endif
}
