// SPDX-License-Identifier: MIT
//
// Options of the method of successive approximations.
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/checks.hpp>
#include <slant/newton/forcing.hpp>

namespace slant {

/// Options of successive_approximations.
template <class S = double>
struct successive_options {
  /// η, relative to the residual R: more than Ψ brings the parameters nearer is wasted. With a goal
  /// the last problem is not solved too well. Measured for Coulomb friction on bricks (k = 6): the
  /// products for 0.5 … 0.1 differ by a fifth at most, 0.02 takes up to a half more.
  eisenstat_walker forcing{.γ = 1, .exponent = 1.001, .η_max = 0.3, .η_first = 0.3};
  /// Differences that Anderson's acceleration keeps; 0: none. One is a secant rule. More of them
  /// see errors of inexact solves: on the same bricks 5 took up to a quarter more products than 1.
  index window = 1;
  S growth = S(2);      ///< >= 1: the residual may grow so much in a step before it is a failure
  S relaxation = S(1);  ///< ω in (0, 1]: p ← p + ω (Ψ(p) − p) for a plain step
  index inner_steps = 200;  ///< of the inner method in one outer step at most
  index patience = 30;      ///< outer steps in which the residual does not fall that mean stalled

  /// Throws bad_input naming the option, its value and what was expected.
  [[gnu::cold]] void validate() const {
    if (window < 0) throw bad_input("window", detail::show(window), "a number >= 0");
    if (!(growth >= S(1)) || !detail::is_finite(growth)) {
      throw bad_input("growth", detail::show(growth), "a finite number >= 1");
    }
    if (!(relaxation > S(0) && relaxation <= S(1))) {
      throw bad_input("relaxation", detail::show(relaxation), "a number in (0, 1]");
    }
    if (inner_steps < 1) throw bad_input("inner_steps", detail::show(inner_steps), "at least 1");
    if (patience < 1) throw bad_input("patience", detail::show(patience), "at least 1");
    forcing.validate();
  }
};

}  // namespace slant
