// SPDX-License-Identifier: MIT
//
// Runs that have said `converged` with an error above the threshold: for each method and adversity
// the mildest one, as `bench_stability --shrink yes` finds it.
#pragma once

#include <array>
#include <stability/methods.hpp>

namespace stability {

struct regression {
  std::string_view method;
  std::string_view adversity;
  double parameter;
  char const* variant;
  double tolerance = 1e-8;
  start_point start = start_point::zero;
};

// clang-format off
inline constexpr std::array regressions{
    regression{"kprgp", "cases", 0, "pair", 1e-8, start_point::far},
    regression{"qpq", "cases", 0, "pair", 1e-8, start_point::far},
    regression{"qpc", "cases", 0, "pair", 1e-8, start_point::far},
};
// clang-format on

}  // namespace stability
