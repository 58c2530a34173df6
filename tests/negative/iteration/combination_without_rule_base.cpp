// SPDX-License-Identifier: MIT
// expect: an own stopping rule must derive from slant::rule.*'slant::rule' is not a base of 'never'
// expect-clang: an own stopping rule must derive from slant::rule.*'combinable_rule['<]
// max-lines-gcc: 20
// max-lines-clang: 25
//
// A rule of its own that is not derived from slant::rule and so has no part in || and &&.
#include <slant/slant.hpp>

#ifdef SLANT_COMPLETE
struct never : slant::rule {
#else
struct never {
#endif
  slant::status operator()(auto const&) const { return slant::status::running; }
  std::string reason(auto const&) const { return ""; }
};

auto const rule = never{} || slant::at_most(10);
