// SPDX-License-Identifier: MIT
// expect: laws must be a public static constexpr slant::laws<...>
// max-lines-gcc: 15
// max-lines-clang: 25
//
// Laws that nobody may read would silently be none.
#include <slant/concepts/linear_operator.hpp>

class half {
#ifdef SLANT_COMPLETE
 public:
#endif
  static constexpr auto laws = slant::laws<slant::self_adjoint>;
};

static_assert(slant::laws_of<half>.contains(slant::self_adjoint));
