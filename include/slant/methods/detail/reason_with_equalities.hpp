// SPDX-License-Identifier: MIT
//
// What the statuses of methods for problems with equality constraints mean.
#pragma once

#include <slant/iteration/report.hpp>

#include <string>

namespace slant::detail {

/// `infeasible`: no point of Λ satisfies G x = e, which has been shown.
[[nodiscard, gnu::cold]] inline std::string reason_with_equalities(slant::status end,
                                                                   bool infeasible) {
  switch (end) {
    case slant::status::converged:
      return "the reduced gradient and the residual of the equality constraints vanish";
    case slant::status::stalled:
      return infeasible ? "no point of the set satisfies the equality constraints"
                        : "neither the reduced gradient nor the residual of the equality "
                          "constraints falls any further at this precision";
    case slant::status::unbounded:
      return "the function decreases for ever along a direction of the set";
    case slant::status::breakdown:
      return "a number left the range of the scalar, or A is not positive semidefinite";
    default:
      return std::string(to_string(end));
  }
}

}  // namespace slant::detail
