// SPDX-License-Identifier: MIT
//
// The parameters of KPRGP.
#pragma once

#include <slant/concepts/checks.hpp>
#include <slant/krylov/spectral_bound.hpp>

#include <optional>

namespace slant {

/// Which blocks count as free when a face is chosen.
enum class active_set_rule : unsigned char {
  boundary,  ///< those in which x is not on the boundary: f_i < 0 [K §3.1.1]
  semismooth  ///< those in which P_Λ(x − α̃ r) is not: the sets of semismooth Newton [K (60), (61)]
};

/// Options of kprgp.
template <class S>
struct kprgp_options {
  S proportioning = S(1);  ///< Γ > 0 of [K (33)]: large keeps the face, small releases early
  std::optional<S> step_length{};  ///< α̃ in (0, 2/σ_max); not given: see krylov/gradient_step.hpp
  S step_factor = S(1.9);          ///< in (0, 2), of that step; the bricks need half the steps of 1
  active_set_rule active_sets = active_set_rule::boundary;  ///< `semismooth` is AS-S [K Ex 5]
  bool half_step = true;  ///< a CG step that leaves Λ is first followed up to the boundary
  index refresh = 50;     ///< CG steps after which r = A x − b is recomputed; 0: never
  index patience = 1000;  ///< steps in which neither ‖r̃‖ nor q falls that mean stalled
  spectral_bound_options spectrum{};  ///< how σ_max is bounded, if it is needed

  /// Throws bad_input naming the option, its value and what was expected.
  [[gnu::cold]] void validate() const {
    if (!(proportioning > S(0)) || !detail::is_finite(proportioning)) {
      throw bad_input("proportioning", detail::show(proportioning), "a number > 0");
    }
    if (step_length && (!(*step_length > S(0)) || !detail::is_finite(*step_length))) {
      throw bad_input("step_length", detail::show(*step_length), "a number > 0");
    }
    if (!(step_factor > S(0) && step_factor < S(2))) {
      throw bad_input("step_factor", detail::show(step_factor), "a number in (0, 2)");
    }
    if (refresh < 0) throw bad_input("refresh", detail::show(refresh), "a number >= 0");
    if (patience < 0) throw bad_input("patience", detail::show(patience), "a number >= 0");
    spectrum.validate();
  }
};

}  // namespace slant
