// SPDX-License-Identifier: MIT
//
// When the inner iterations of a Newton step end.
#pragma once

#include <slant/concepts/checks.hpp>
#include <slant/concepts/distributed.hpp>
#include <slant/concepts/iterative_method.hpp>

#include <limits>

namespace slant::detail {

/// Throws bad_input unless it is a number of iterations, or 0 for "choose".
inline void check_iteration_limit(index max_iterations) {
  if (max_iterations < 0) {
    throw bad_input("max_iterations", show(max_iterations), "a number >= 0");
  }
}

/// The limit given, or one that only a failure reaches: n iterations suffice without rounding.
template <class V>
[[nodiscard]] index iteration_limit(index max_iterations, V const& f) {
  return max_iterations > 0 ? max_iterations : 10 * slant::global_size(f) + 100;
}

/// A tolerance below the rounding error of a residual cannot be told from it.
template <class S>
[[nodiscard]] S attainable(S const& tolerance) {
  S const ε = std::numeric_limits<S>::epsilon();
  return tolerance > ε ? tolerance : ε;
}

/// Steps of an inner method until its residual is small enough, or it cannot or may not go on;
/// after_step(s) is called in between.
template <class Method, class State, class S, class AfterStep>
void run_until(Method const& method, State& s, S const& target, index limit, AfterStep after_step) {
  while (s.status == status::running && !(s.residual_norm <= target) && s.iteration < limit) {
    method.step(s);
    after_step(s);
  }
}

/// How the run ended, as the status of a linear solver.
template <class State, class S>
[[nodiscard]] status verdict_on(State const& s, S const& target) {
  if (s.residual_norm <= target) return status::converged;
  return s.status == status::running ? status::iteration_limit : s.status;
}

}  // namespace slant::detail
