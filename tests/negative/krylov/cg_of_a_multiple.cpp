// SPDX-License-Identifier: MIT
// expect: A must.*'declares_positive_semidefinite['<]
// max-lines-gcc: 22
// max-lines-clang: 30
//
// The multiple of a definite operator by a number of any sign.
#include <slant/krylov/cg.hpp>
#include <slant/operators/identity.hpp>
#include <slant/operators/product.hpp>

#include <Eigen/Core>

#ifdef SLANT_COMPLETE
auto const two = 2.0;
#else
auto const two = slant::any_sign(2.0);
#endif

auto method(Eigen::VectorXd const& b) {
  return slant::cg{slant::scaled(two, slant::identity_operator(2)), b};
}
