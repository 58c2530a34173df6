// SPDX-License-Identifier: MIT
//
// Options of SMALSE-M.
#pragma once

#include <slant/concepts/checks.hpp>
#include <slant/krylov/spectral_bound.hpp>
#include <slant/methods/kprgp_options.hpp>

namespace slant {

/// Options of smalse.
template <class S = double>
struct smalse_options {
  /// ρ in multiples of σ_max(P A P); it does not grow. Measured with Total-FETI on bricks: 4 halves
  /// the outer steps and doubles the products of KPRGP.
  S penalty = S(1);
  /// M₀ in multiples of ρ: inner problems until ‖r̃‖ ≤ M ‖G x − e‖. Of 0.3, 1 and 5 the first took
  /// the least products, down to half of those of the last.
  S balance = S(0.3);
  S shrink = S(0.1);  ///< β in (0, 1): M ← β M if L has not grown enough
  S precision = S(0.1);  ///< η in multiples of ‖P (b − A x̄)‖: ‖r̃‖ ≤ η at least, from the first on
  index inner_steps = 5000;  ///< of one inner problem at most
  index patience = 30;       ///< outer steps in which the error does not fall that mean stalled
  spectral_bound_options spectrum{};  ///< how σ_max(P A P) is bounded
  kprgp_options<S> inner{};  ///< step_length, if not given: from σ, an upper bound of σ_max

  /// Throws bad_input naming the option, its value and what was expected.
  [[gnu::cold]] void validate() const {
    require_positive("penalty", penalty);
    require_positive("balance", balance);
    require_positive("precision", precision);
    if (!(shrink > S(0) && shrink < S(1))) {
      throw bad_input("shrink", detail::show(shrink), "a number in (0, 1)");
    }
    if (inner_steps < 1) throw bad_input("inner_steps", detail::show(inner_steps), "at least 1");
    if (patience < 1) throw bad_input("patience", detail::show(patience), "at least 1");
    spectrum.validate();
    inner.validate();
  }

 private:
  static void require_positive(char const* name, S const& value) {
    if (!(value > S(0)) || !detail::is_finite(value)) {
      throw bad_input(name, detail::show(value), "a finite number > 0");
    }
  }
};

}  // namespace slant
