// SPDX-License-Identifier: MIT
// case OTHER_BLOCKS: erased: expected a program on Eigen vectors, with a set of blocks of the kinds that
// case WITHOUT_LAWS: erased: A must declare that it is self-adjoint and positive semidefinite
// max-lines-gcc: 12
// max-lines-clang: 12
//
// An any_set is a list of known kinds; another block keeps its type. Methods ask the forgotten program
// for laws, so they must be promised before.
#include <slant/problems/any_qp.hpp>
#include <slant/sets/ball.hpp>
#include <slant/sets/power.hpp>

#ifdef OTHER_BLOCKS
using some_ball = slant::ball<4>;
#else
using some_ball = slant::ball<2>;
#endif

struct twice {
#ifdef WITHOUT_LAWS
  static constexpr auto laws = slant::laws<slant::self_adjoint>;
#else
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::positive_semidefinite>;
#endif
  Eigen::Index rows() const { return 12; }
  Eigen::Index cols() const { return 12; }
  void apply(auto const& x, auto& y) const { y = 2 * x; }
};

void forget(Eigen::VectorXd const& b) {
  auto const set = slant::power(some_ball{}, 3);
  slant::separable_qp const qp{twice{}, b, set};
  auto const forgotten = slant::erased(qp);
}
