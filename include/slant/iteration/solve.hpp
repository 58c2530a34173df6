// SPDX-License-Identifier: MIT
//
// The driver. It knows no mathematics: start, look, step, look, … until somebody says stop.
#pragma once

#include <slant/iteration/report.hpp>
#include <slant/iteration/stopping.hpp>

#include <string>
#include <type_traits>
#include <utility>

namespace slant {

namespace detail {

template <class State>
std::string own_words(State const& s) {
  if constexpr (requires { std::string(s.reason()); }) {
    return s.reason();
  } else {
    return "the method reports: " + std::string(to_string(s.status));
  }
}

}  // namespace detail

/// Runs a method from x0 until its state leaves `running` or the rule fires; every observer sees
/// every state, the first included. Throws bad_input if the method refuses x0; never throws for
/// numerical trouble, which is report.status. A method that updates its residual has to show
/// success by a residual computed from x: has_refresh, one application more.
template <class Method, class V, class Rule, class... Observers>
  requires iterative_method<Method, V> && stopping_rule<Rule, state_t<Method, V>> &&
           (observer<Observers, state_t<Method, V>> && ...)
[[nodiscard]] auto solve(Method&& method, V const& x0, Rule stop, Observers&&... observers)
    -> report<state_t<Method, V>> {
  using state_type = state_t<Method, V>;
  state_type state = method.start(x0);
  auto const end = [&state](status how, std::string why) {
    return report<state_type>{std::move(state), how, std::move(why)};
  };
  while (true) {
    (observers(std::as_const(state)), ...);
    status verdict = stop(std::as_const(state));
    if constexpr (has_refresh<std::remove_reference_t<Method>, state_type>) {
      bool const success = verdict == status::converged || state.status == status::converged;
      if (success && method.refresh(state)) {
        verdict = stop(std::as_const(state));
      }
    }
    // Success first: whoever else wants to stop in the step that succeeds has nothing to add.
    if (verdict == status::converged) return end(verdict, stop.reason(state));
    if (state.status != status::running) return end(state.status, detail::own_words(state));
    if (verdict != status::running) return end(verdict, stop.reason(state));
    method.step(state);
  }
}

}  // namespace slant
