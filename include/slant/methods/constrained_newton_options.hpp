// SPDX-License-Identifier: MIT
//
// Options of the semismooth Newton method with equality constraints.
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/checks.hpp>
#include <slant/krylov/mean_diagonal.hpp>
#include <slant/methods/smalse_options.hpp>
#include <slant/newton/forcing.hpp>

namespace slant {

/// Options of constrained_newton; the defaults are those of benchmarks/total_feti.cpp.
template <scalar S = double>
struct constrained_newton_options {
  S step_factor = S(0.5);                 ///< α in multiples of 1/mean(diag P A P)
  mean_diagonal_options mean_diagonal{};  ///< how that is estimated
  /// Inner accuracy, relative to the merit function.
  eisenstat_walker forcing{.γ = 0.9, .exponent = 1.5, .η_max = 0.1, .η_first = 0.1};
  index inner_steps = 1000;  ///< conjugate gradient steps of one Newton step at most
  S sufficient =
      S(0.1);  ///< c in (0, 1): a step of length β lowers the merit by c β of it at least
  index halvings = 20;           ///< β = 1, ½, …: so often at most
  index patience = 100;          ///< steps in which the merit does not fall that mean stalled
  smalse_options<S> fallback{};  ///< of the method that takes over where Newton's fails

  /// Throws bad_input naming the option, its value and what was expected.
  [[gnu::cold]] void validate() const {
    if (!(step_factor > S(0)) || !detail::is_finite(step_factor)) {
      throw bad_input("step_factor", detail::show(step_factor), "a number > 0");
    }
    if (inner_steps < 1) throw bad_input("inner_steps", detail::show(inner_steps), "at least 1");
    if (!(sufficient > S(0) && sufficient < S(1))) {
      throw bad_input("sufficient", detail::show(sufficient), "a number in (0, 1)");
    }
    if (halvings < 0) throw bad_input("halvings", detail::show(halvings), "a number >= 0");
    if (patience < 0) throw bad_input("patience", detail::show(patience), "a number >= 0");
    mean_diagonal.validate();
    forcing.validate();
    fallback.validate();
  }
};

}  // namespace slant
