// SPDX-License-Identifier: MIT
//
// The methods in the tables of the brick.
#pragma once

#include <support/contact_methods.hpp>
#include <tuple>

namespace brick_tables {

[[nodiscard]] inline auto methods() {
  return std::tuple{examples::imssn("IMSSN", 1.9),
                    examples::gimssn("GIMSSN", 1.9),
                    examples::kprgp("KPRGP", 1.9),
                    examples::interior_point("PF"),
                    examples::preconditioned_interior_point("PF, M"),
                    examples::newton("Newton"),
                    examples::preconditioned_newton("Newton, M")};
}

}  // namespace brick_tables
