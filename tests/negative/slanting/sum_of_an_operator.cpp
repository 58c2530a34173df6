// SPDX-License-Identifier: MIT
// expect: 'has_value_member['<]
// max-lines-gcc: 25
// max-lines-clang: 30
//
// An operator is not a function: the sum needs y ↦ A y, slant::linear(A).
#include <slant/slanting/affine.hpp>
#include <slant/slanting/arithmetic.hpp>

#ifdef SLANT_COMPLETE
auto const term = slant::linear(slant::identity_operator(2));
#else
slant::identity_operator const term(2);
#endif

auto const f = slant::add(slant::identity_map(2), term);
