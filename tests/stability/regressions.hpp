// SPDX-License-Identifier: MIT
//
// Runs that have said `converged` with an error above the threshold or without a number, or
// `unbounded`, or have claimed less than half of their error: for each method and adversity the
// mildest one, as `bench_stability --shrink yes` finds it.
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
    regression{"interior_point", "cases", 0, "disc 2"},
    regression{"kprgp", "energy", -300, "1", 1e-15},
    regression{"as_s", "energy", -300, "1", 1e-15},
    regression{"mssn", "blocks", 4, "1", 1e-8, start_point::extreme},
    regression{"imssn", "blocks", 4, "1", 1e-8, start_point::extreme},
    regression{"kprgp_float", "blocks", 4, "1", 1e-8, start_point::far},
    regression{"solve", "blocks", 8, "1", 1e-2},
    regression{"interior_point_long_double", "blocks", 8, "1", 1e-8, start_point::boundary},
    regression{"interior_point_float", "blocks", 4, "4"},
    regression{"symmetric_newton_float", "blocks", 8, "1", 1e-8, start_point::far},
    regression{"solve", "blocks", 8, "2", 1e-2},
    regression{"ssn_primal_dual", "thickness", 0.0001, "press"},
    regression{"kprgp", "thickness", 1, "press"},
    regression{"gimssn", "thickness", 1, "press"},
    regression{"symmetric_newton", "thickness", 0.1, "press"},
    regression{"symmetric_newton_equilibrated", "thickness", 0.1, "press"},
    regression{"interior_point", "thickness", 0.1, "press"},
    regression{"semismooth_newton", "thickness", 0.1, "press"},
    regression{"ssn", "thickness", 0.1, "lift"},
    regression{"ssnm_b", "thickness", 0.0001, "press"},
    regression{"ssnm_b", "energy", -150, "1/1"},
    regression{"as_s", "redundant", 1e-08, "1/2"},
    regression{"gimssn", "redundant", 0.0001, "1/3"},
    regression{"imssn", "redundant", 1e-08, "2/1"},
    regression{"interior_point", "redundant", 0.0001, "1/2"},
    regression{"interior_point_long_double", "redundant", 0.0001, "1/2"},
    regression{"kprgp", "redundant", 1e-08, "1/2"},
    regression{"kprgp_long_double", "redundant", 1e-08, "1/2"},
    regression{"mssn", "redundant", 1e-08, "1/4"},
    regression{"qpc", "redundant", 1e-08, "1/2"},
    regression{"qpq", "redundant", 1e-08, "1/2"},
    regression{"semismooth_newton", "redundant", 1e-08, "1/2"},
    regression{"ssn", "redundant", 1e-08, "2/1"},
    regression{"symmetric_newton", "redundant", 1e-08, "1/2"},
    regression{"symmetric_newton_equilibrated", "redundant", 0.0001, "1"},
    regression{"symmetric_newton_long_double", "redundant", 0.0001, "3/5"},
    regression{"symmetric_newton_plain", "redundant", 1e-08, "1/2"},
    regression{"gimssn", "blocks", 4, "1/2"},
    regression{"imssn", "blocks", 4, "1/2"},
    regression{"qpc", "blocks", 8, "1/2"},
    regression{"semismooth_newton", "blocks", 4, "1/2"},
    regression{"ssn", "blocks", 2, "1/3"},
    regression{"ssnm_a", "blocks", 4, "1/4"},
    regression{"ssnm_b", "blocks", 8, "2/1"},
    regression{"symmetric_newton_long_double", "blocks", 2, "4/4"},
    regression{"symmetric_newton_plain", "blocks", 2, "4/4"},
};
// clang-format on

}  // namespace stability
