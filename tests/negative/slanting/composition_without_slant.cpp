// SPDX-License-Identifier: MIT
// expect: 'has_slant_member['<]
// max-lines-gcc: 25
// max-lines-clang: 30
//
// The inner function of a composition minus its slanting operator.
#include <slant/slanting/affine.hpp>
#include <slant/slanting/composition.hpp>

struct doubling {
  slant::index rows() const { return 2; }
  slant::index cols() const { return 2; }
  void value(auto const& y, auto& f) const { f = 2 * y; }
#ifdef SLANT_COMPLETE
  auto slant(auto const&) const { return slant::identity_operator(2); }
#endif
};

auto const f = slant::compose(slant::identity_map(2), doubling{});
