// SPDX-License-Identifier: MIT
// expect: slant needs NaN and infinity
// max-lines-gcc: 5
// max-lines-clang: 5
// first: nothing
//
// What -ffast-math and -Ofast say of themselves, minus NaN.
#ifdef SLANT_COMPLETE
// as the compiler is by default
#else
#undef __FINITE_MATH_ONLY__
#define __FINITE_MATH_ONLY__ 1
#endif
#include <slant/concepts/scalar.hpp>

static_assert(slant::scalar<double>);
