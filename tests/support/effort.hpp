// SPDX-License-Identifier: MIT
#pragma once

namespace test {

/// Whether this is compiled with optimisation: for test cases that take minutes without, decorated
/// with `* doctest::skip(!test::is_optimised)`.
#ifdef __OPTIMIZE__
inline constexpr bool is_optimised = true;
#else
inline constexpr bool is_optimised = false;
#endif

/// How much a test takes on: `full` where the compiler optimises, else `light`. Without
/// optimisation and with sanitizers the same work takes fifty times as long, and a little of it
/// shows them as much.
template <class T>
constexpr T effort(T full, T light) {
  return is_optimised ? full : light;
}

}  // namespace test
