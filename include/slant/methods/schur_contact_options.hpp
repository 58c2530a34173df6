// SPDX-License-Identifier: MIT
//
// Options of the Schur complement contact algorithm.
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/checks.hpp>

namespace slant {

/// Options of schur_contact.
template <scalar S = double>
struct schur_contact_options {
  /// Γ ≥ 0 in the test of the residuum [D (ix)]: rows are released where ‖φ‖ ≤ Γ ‖β‖, φ = V Vᵀr
  /// what the face can still gain and β what releasing rows can. 0: only where φ = 0 up to
  /// rounding, as the paper has it. Measured on stacks of bricks: ½ and 1 alike, 0 three to four
  /// times the steps.
  S release = S(0.5);
  /// Points P(u + t q), t = α, α/2, …, that are tried where the step to the minimum along q leaves
  /// the set, before the step to the first constraint. Each costs one product and one application
  /// of Q. 0: the paper's update, by one index as a rule. Measured on stacks of bricks with gaps: 1
  /// and 3 alike, half of the products and a sixth of the changes of J that 0 needs; without gaps
  /// no difference.
  index projected_trials = 1;
  index patience = 1000;  ///< steps in which neither the residual nor the energy falls: stalled

  /// Throws bad_input naming the option, its value and what was expected.
  [[gnu::cold]] void validate() const {
    if (!(release >= S(0)) || !detail::is_finite(release)) {
      throw bad_input("release", detail::show(release), "a number >= 0");
    }
    if (projected_trials < 0) {
      throw bad_input("projected_trials", detail::show(projected_trials), "a number >= 0");
    }
    if (patience < 0) throw bad_input("patience", detail::show(patience), "a number >= 0");
  }
};

}  // namespace slant
