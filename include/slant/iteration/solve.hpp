// SPDX-License-Identifier: MIT
//
// The driver. It knows no mathematics: start, look, step, look, … until somebody says stop.
#pragma once

#include <slant/base/report.hpp>
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

/// What solve asks of its arguments.
template <class Method, class V, class Rule, class... Observers>
concept solvable = iterative_method<Method, V> && stopping_rule<Rule, state_t<Method, V>> &&
                   (observer<Observers, state_t<Method, V>> && ...);

template <class Observer, class State>
void check_observer() {
  static_assert(observer<Observer, State>, "solve: an observer must take states of this method");
}

/// What solve returns after a static_assert has refused its arguments; nothing of it is defined.
template <class V>
struct refused_report {
  slant::status status;
  std::string reason;
  V const& x() const;
  index iterations() const;
  bool converged() const;
};

}  // namespace detail

namespace detail {

/// How a run ended, and the same as a sentence.
struct ending {
  status how;
  std::string why;
};

/// Runs a method from a state that it has made until the state leaves `running` or the rule fires.
template <class Method, class State, class Rule, class... Observers>
[[nodiscard]] ending run_to_end(Method& method, State& state, Rule& stop, Observers&... observers) {
  while (true) {
    (observers(std::as_const(state)), ...);
    status verdict = stop(std::as_const(state));
    if constexpr (has_refresh<std::remove_reference_t<Method>, State>) {
      bool const success = verdict == status::converged || state.status == status::converged;
      if (success && method.refresh(state)) {
        verdict = stop(std::as_const(state));
      }
    }
    // Convergence takes precedence over any other reason to stop in the same step.
    if (verdict == status::converged) return {verdict, stop.reason(state)};
    // A rule that has looked at the error may deny what the method believes, and adds to what it
    // says of its end.
    if (verdict == status::stalled && state.status == status::converged)
      return {verdict, stop.reason(state)};
    if (verdict == status::stalled && state.status == status::stalled)
      return {verdict, stop.reason(state) + "; " + own_words(state)};
    if (state.status != status::running) return {state.status, own_words(state)};
    if (verdict != status::running) return {verdict, stop.reason(state)};
    method.step(state);
  }
}

}  // namespace detail

/// Runs a method from x0 until its state leaves `running` or the rule fires; every observer sees
/// every state, the first included. Throws bad_input if the method refuses x0; never throws for
/// numerical trouble, which is report.status. A method that updates its residual has to show
/// success by a residual computed from x: has_refresh, one application more.
template <class Method, class V, class Rule, class... Observers>
  requires detail::solvable<Method, V, Rule, Observers...>
[[nodiscard]] auto solve(Method&& method, V const& x0, Rule stop, Observers&&... observers)
    -> report<state_t<Method, V>> {
  state_t<Method, V> state = method.start(x0);
  auto end = detail::run_to_end(method, state, stop, observers...);
  return {std::move(state), end.how, std::move(end.why)};
}

/// Arguments that lack something end here and are told so.
template <class Method, class V, class Rule, class... Observers>
  requires(!detail::solvable<Method, V, Rule, Observers...> && !scalar<V> && !scalar<Rule>)
[[nodiscard]] auto solve(Method&&, V const&, Rule, Observers&&...) -> detail::refused_report<V> {
  static_assert(
      iterative_method<Method, V>,
      "solve: the method must have start(x0), step(state), and states with x, iteration, status");
  if constexpr (iterative_method<Method, V>) {
    using state = state_t<Method, V>;
    static_assert(stopping_rule<Rule, state>, "solve: the rule must judge states of this method");
    (detail::check_observer<Observers, state>(), ...);
  }
  return {};
}

}  // namespace slant
