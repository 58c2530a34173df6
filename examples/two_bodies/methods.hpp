// SPDX-License-Identifier: MIT
//
// The methods in the tables of two bodies, with step lengths β/σ_max as in the lecture.
#pragma once

#include <fem/lecture_ssn.hpp>
#include <slant/iteration/stopping.hpp>
#include <support/contact_methods.hpp>
#include <tuple>

namespace two_bodies {

/// The rule of SSN: ‖y⁺ − y‖ ≤ ε ‖y⁺‖.
struct step_rule {
  [[nodiscard]] auto operator()(examples::run_limits const& limits) const {
    return slant::step_below(limits.tolerance) || slant::at_most(limits.max_iterations);
  }
};

/// Columns beside [K Table 5]. KPRGP with intervals is the lecture's AS.
[[nodiscard]] inline auto plane_methods() {
  return std::tuple{examples::gimssn("GIMSSN 1.9", 1.9), examples::as_s("AS-S 20", 20),
                    examples::kprgp("AS 1.9", 1.9),      examples::kprgp("AS 15", 15),
                    examples::newton("Newton"),          examples::dirichlet_newton("Newton, M")};
}

/// Columns beside [K Table 6].
[[nodiscard]] inline auto space_methods() {
  return std::tuple{examples::named_method{"SSN",
                                           [](auto const& problem) {
                                             return fem::make_lecture_ssn(problem.dual(),
                                                                          1.9 / problem.sigma());
                                           },
                                           step_rule{}, false},
                    examples::imssn("IMSSN", 1.9),
                    examples::gimssn("GIMSSN", 1.9),
                    examples::kprgp("KPRGP", 1.9),
                    examples::newton("Newton"),
                    examples::dirichlet_newton("Newton, M")};
}

}  // namespace two_bodies
