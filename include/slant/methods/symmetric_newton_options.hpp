// SPDX-License-Identifier: MIT
//
// Options of symmetric_newton, with a set or with another convex function.
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/scalar.hpp>
#include <slant/krylov/mean_diagonal.hpp>
#include <slant/methods/proportioning.hpp>
#include <slant/newton/forcing.hpp>

#include <optional>

namespace slant {

/// Options of symmetric_newton; the defaults are those of README's tables.
template <scalar S = double>
struct symmetric_newton_options {
  /// ρ in x − P_Λ(x − ρ r), in units of 1/A; none: step_factor / mean(diag A).
  std::optional<S> step_length{};
  /// > 0, of the order 1. An undamped step leaves r = 0 on blocks that were free and x on its bound
  /// where it was fixed, so that signs decide what is free next and not ρ; damped steps mix the
  /// two. Measured on bricks (k = 4 … 16): ¼ and ½ alike, 1 up to a quarter more products. On the
  /// wire from zero, with A⁻¹ as preconditioner, 2 needs half of the steps that ½ needs.
  S step_factor = S(0.5);
  mean_diagonal_options mean_diagonal{};  ///< how mean(diag A) is estimated, if it is needed
  /// Inner accuracy. The exponent 3/2 makes the steps superlinear of that order; η_max is what a
  /// step deserves that will be shortened; with a goal the last step is not solved too well.
  eisenstat_walker forcing{.γ = 0.9, .exponent = 1.5, .η_max = 0.5, .η_first = 0.3};
  index inner_steps = 1000;  ///< conjugate gradient steps of one Newton step at most
  S sufficient = S(0.1);  ///< c in (0, 1): a step of length β lowers ‖F‖ by c β ‖F‖ at least
  /// Of envelope_newton with a preconditioner that knows faces: ‖x − x*‖_A, as ‖Π(r + v)‖_M
  /// estimates it, at which x is good enough; 0: never.
  S energy_goal = S(0);
  index halvings = 30;   ///< β = 1, ½, …: so often at most
  index patience = 100;  ///< steps in which ‖F‖ does not fall that mean stalled
  kprgp_options<S> descent{.patience = 200};  ///< of the method that takes over where Newton fails

  /// Throws bad_input naming the option, its value and what was expected.
  [[gnu::cold]] void validate() const {
    if (step_length && (!(*step_length > S(0)) || !detail::is_finite(*step_length))) {
      throw bad_input("step_length", detail::show(*step_length), "a number > 0");
    }
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
    descent.validate();
  }
};

}  // namespace slant
