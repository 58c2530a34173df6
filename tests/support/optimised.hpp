// SPDX-License-Identifier: MIT
//
// Whether this is compiled with optimisation: for test cases that take minutes without, decorated
// with `* doctest::skip(!test::is_optimised)`.
#pragma once

namespace test {

#ifdef __OPTIMIZE__
inline constexpr bool is_optimised = true;
#else
inline constexpr bool is_optimised = false;
#endif

}  // namespace test
