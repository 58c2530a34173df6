// SPDX-License-Identifier: MIT
//
// The parameters of semismooth_newton that are not those of one of its parts.
#pragma once

#include <slant/concepts/checks.hpp>

namespace slant {

/// What the error is by which forcing terms are chosen.
enum class newton_error : unsigned char {
  residual,  ///< err⁽ᵏ⁾ = ‖F(y⁽ᵏ⁾)‖, relative to that at the start
  step  ///< err⁽ᵏ⁾ = ‖dy⁽ᵏ⁻¹⁾‖ / (‖y⁽ᵏ⁾‖ + step_offset), 1 at the start [T §3.4]
};

/// Where ‖F‖ is taken that residuals are judged by.
enum class newton_scale : unsigned char {
  origin,  ///< ‖F(0)‖, as ‖b‖ for linear systems; ‖F(y₀)‖ if that is 0 or not finite
  start    ///< ‖F(y₀)‖: where F must not be evaluated at 0. Depends on the start
};

/// Options of semismooth_newton.
struct newton_options {
  newton_error error = newton_error::residual;  ///< what forcing terms see
  double step_offset = 0;                       ///< ≥ 0, in units of y; [T] has 1
  newton_scale scale = newton_scale::origin;    ///< what residual_below is relative to
  index patience = 100;  ///< steps without a new smallest ‖F‖ that mean stalled

  /// Throws bad_input naming the option, its value and what was expected.
  [[gnu::cold]] void validate() const {
    if (!(step_offset >= 0) || !detail::is_finite(step_offset)) {
      throw bad_input("step_offset", detail::show(step_offset), "a number >= 0");
    }
    if (patience < 0) throw bad_input("patience", detail::show(patience), "a number >= 0");
  }
};

}  // namespace slant
