// SPDX-License-Identifier: MIT
// expect: a row of a stack must be a slanting function.*'has_value_member['<]
// max-lines-gcc: 25
// max-lines-clang: 30
//
// A row of a stack minus its value.
#include <slant/slanting/affine.hpp>
#include <slant/slanting/stack.hpp>

struct doubling {
  slant::index rows() const { return 2; }
  slant::index cols() const { return 2; }
#ifdef SLANT_COMPLETE
  void value(auto const& y, auto& f) const { f = 2 * y; }
#endif
  auto slant(auto const&) const { return slant::identity_operator(2); }
};

auto const f = slant::stack(slant::identity_map(2), doubling{});
