// SPDX-License-Identifier: MIT
//
// The parameters of MSSN, IMSSN and GIMSSN.
#pragma once

#include <slant/concepts/checks.hpp>
#include <slant/krylov/spectral_bound.hpp>
#include <slant/methods/modified_newton_parts.hpp>

#include <optional>

namespace slant {

/// Options of mssn, imssn and gimssn. Forcing is a rule of newton/forcing.hpp.
template <class S, class Forcing>
struct modified_newton_options {
  Forcing forcing = default_forcing<Forcing>;  ///< how accurately q is minimised on a face
  std::optional<S> step_length{};  ///< ρ > 0 of z = λ − ρ r; not given: β / σ_max
  S step_factor = S(1.9);          ///< β > 0; below 2 for gimssn, whose descent it guarantees
  index max_inner = 1000;          ///< inner iterations a step at most
  index refresh = 50;              ///< inner iterations after which a step computes r anew even
                                   ///< where it could be kept; 0: never
  index patience = 100;  ///< steps in which neither ‖r̃‖ nor q falls that mean stalled
  spectral_bound_options spectrum{};  ///< how σ_max is bounded, if it is needed

  /// Throws bad_input naming the option, its value and what was expected.
  [[gnu::cold]] void validate() const {
    forcing.validate();
    if (step_length && (!(*step_length > S(0)) || !detail::is_finite(*step_length))) {
      throw bad_input("step_length", detail::show(*step_length), "a number > 0");
    }
    if (!(step_factor > S(0)) || !detail::is_finite(step_factor)) {
      throw bad_input("step_factor", detail::show(step_factor), "a number > 0");
    }
    if (max_inner < 1) throw bad_input("max_inner", detail::show(max_inner), "a number >= 1");
    if (refresh < 0) throw bad_input("refresh", detail::show(refresh), "a number >= 0");
    if (patience < 0) throw bad_input("patience", detail::show(patience), "a number >= 0");
    spectrum.validate();
  }
};

}  // namespace slant
