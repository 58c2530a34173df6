// SPDX-License-Identifier: MIT
// case WITHOUT_SLANT: 'has_slant_member['<]
// case WITHOUT_VALUE: a row of a stack must be a slanting function.*'has_value_member['<]
// case OPERATOR: 'has_value_member['<]
// case SLANT_OF_NUMBERS: 'has_slant_operator['<]
// max-lines-gcc: 25
// max-lines-clang: 30
//
// The inner function of a composition minus its slanting operator; a row of a stack minus its
// value. An operator is not a function: a sum needs y ↦ A y, slant::linear(A). A function whose
// F°(y) is a matrix, and not an operator that could be applied.
#include <slant/slant.hpp>

struct doubling {
  slant::index rows() const { return 2; }
  slant::index cols() const { return 2; }
#ifndef WITHOUT_VALUE
  void value(auto const& y, auto& f) const { f = 2 * y; }
#endif
#if defined(SLANT_OF_NUMBERS)
  Eigen::Matrix2d slant(auto const&) const { return 2 * Eigen::Matrix2d::Identity(); }
#elif !defined(WITHOUT_SLANT)
  auto slant(auto const&) const { return slant::identity_operator(2); }
#endif
};

#ifdef OPERATOR
slant::identity_operator const term(2);
#else
auto const term = slant::linear(slant::identity_operator(2));
#endif

auto const sum = slant::add(slant::identity_map(2), term);
#ifndef WITHOUT_VALUE
auto const composition = slant::compose(slant::identity_map(2), doubling{});
#endif
#ifndef WITHOUT_SLANT
auto const rows = slant::stack(slant::identity_map(2), doubling{});
#endif
#if !defined(WITHOUT_VALUE) && !defined(WITHOUT_SLANT)
static_assert(slant::slanting_function<doubling, Eigen::VectorXd>);
#endif
