// SPDX-License-Identifier: MIT
//
// The parameters of QPC.
#pragma once

#include <slant/concepts/checks.hpp>
#include <slant/methods/kprgp_options.hpp>

#include <optional>

namespace slant {

/// Options of qpc: those of kprgp with another rule.
template <class S>
struct qpc_options {
  S face_accuracy = S(0.1);  ///< in [0, 1): CG goes on until ‖φ‖ is this fraction of its first size
                             ///< on the face, and of ‖β‖. Small: nearly the minimum on each face
  std::optional<S> step_length{};  ///< as for kprgp, and so the rest
  S step_factor = S(1.9);
  active_set_rule active_sets = active_set_rule::boundary;
  bool half_step = true;
  index refresh = 50;
  index patience = 1000;
  spectral_bound_options spectrum{};

  /// Throws bad_input naming the option, its value and what was expected.
  [[gnu::cold]] void validate() const {
    if (!(face_accuracy >= S(0) && face_accuracy < S(1))) {
      throw bad_input("face_accuracy", detail::show(face_accuracy), "a number in [0, 1)");
    }
    kprgp_options<S>{.step_length = step_length,
                     .step_factor = step_factor,
                     .refresh = refresh,
                     .patience = patience,
                     .spectrum = spectrum}
        .validate();
  }
};

}  // namespace slant
