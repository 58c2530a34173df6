// SPDX-License-Identifier: MIT
#pragma once

namespace test {

/// How much a test takes on: `full` where the compiler optimises, else `light`. Without
/// optimisation and with sanitizers the same work takes fifty times as long, and a little of it
/// shows them as much.
template <class T>
constexpr T effort([[maybe_unused]] T full, [[maybe_unused]] T light) {
#ifdef __OPTIMIZE__
  return full;
#else
  return light;
#endif
}

}  // namespace test
