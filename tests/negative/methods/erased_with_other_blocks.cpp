// SPDX-License-Identifier: MIT
// expect: erased: expected a program on Eigen vectors, with a set of blocks of the kinds that
// max-lines-gcc: 12
// max-lines-clang: 12
//
// An any_set is a list of known kinds; another block keeps its type.
#include <slant/operators/identity.hpp>
#include <slant/problems/any_qp.hpp>
#include <slant/sets/ball.hpp>
#include <slant/sets/power.hpp>

#ifdef SLANT_COMPLETE
using some_ball = slant::ball<2>;
#else
using some_ball = slant::ball<4>;
#endif

void forget(Eigen::VectorXd const& b) {
  auto const set = slant::power(some_ball{}, 3);
  slant::identity_operator const A(b.size());
  slant::separable_qp const qp{A, b, set};
  auto const forgotten = slant::erased(qp);
}
