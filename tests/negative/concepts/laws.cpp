// SPDX-License-Identifier: MIT
// case ENUMERATOR: laws must be a public static constexpr slant::laws<...>
// case NOT_STATIC: laws must be a public static constexpr slant::laws<...>
// case PRIVATE: laws must be a public static constexpr slant::laws<...>
// max-lines-gcc: 15
// max-lines-clang: 25
//
// One law that is not a set of laws; laws as a property of each operator, for which the compiler could
// not ask; laws that nobody may read and that would silently be none.
#include <slant/concepts/linear_operator.hpp>

class half {
#ifndef PRIVATE
 public:
#endif
#if defined(ENUMERATOR)
  static constexpr auto laws = slant::positive_definite;
#elif defined(NOT_STATIC)
  slant::law_set laws = slant::laws<slant::self_adjoint>;
#else
  static constexpr auto laws = slant::laws<slant::self_adjoint>;
#endif
};

static_assert(slant::laws_of<half>.contains(slant::self_adjoint));
