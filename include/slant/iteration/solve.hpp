// SPDX-License-Identifier: MIT
//
// The driver. It knows no mathematics: start, look, step, look, … until somebody says stop.
#pragma once

#include <slant/base/report.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/iteration/stopping.hpp>

#include <concepts>
#include <optional>
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

/// A sparse matrix of Eigen.
template <class V> concept sparse_entries = requires(V const& v) { v.outerIndexPtr(); };

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
    auto const own = state.status;
    if (own != status::running || verdict != status::running) {
      // Convergence takes precedence over any other reason to stop in the same step. A rule that has
      // looked at the error may deny what the method believes, and adds to what it says of its end.
      bool const both_stalled = verdict == status::stalled && own == status::stalled;
      bool const by_rule = own == status::running || verdict == status::converged || both_stalled ||
                           (verdict == status::stalled && own == status::converged);
      std::string why;
      if (by_rule) why = stop.reason(std::as_const(state));
      if (both_stalled) why += "; ";
      if (!by_rule || both_stalled) why += own_words(state);
      return {by_rule ? verdict : own, std::move(why)};
    }
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

/// Arguments that lack something end here and are told so. A number in the place of the rule, where
/// the first is no method, and a matrix in that of x0 are of another solve.
template <class Method, class V, class Rule, class... Observers>
  requires(!detail::solvable<Method, V, Rule, Observers...> &&
           (iterative_method<Method, V> ||
            (!scalar<V> && !scalar<Rule> && !detail::sparse_entries<V>)))
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

// --- solve then ----------------------------------------------------------------------------------
//
// One method, then another: the last iterate of the first starts the second.
//
//     x₁ = solve(first, x₀, stop₁),     x = solve(second, x₁, stop₂)
//
// Interior-point methods come near from anywhere in a number of steps that hardly depends on the
// problem, and lose digits at the end; Newton's method on the active constraints is the other way
// round. The crossover of the two is
//
//     solve_then(interior_point{qp}, reduced_gradient_below(0.1) || at_most(50),
//                symmetric_newton{qp}, x0, reduced_gradient_below(1e-14) || at_most(100))
//
// In place of the second method one may give a function that makes it from the last state of the
// first, so that what was learnt there (a step length, an active set) need not be found again:
//
//     [&](auto const& s) { return symmetric_newton{qp, {.step_length = s.step_length}}; }
//
// Rejected: one state that is now of this, now of that type. Each phase has its report, and its
// work is counted where it was done.

/// What solve_then leaves behind.
template <class First, class Second>
struct sequel_report {
  report<First> first;
  std::optional<report<Second>> second;  ///< none if the first phase left nothing to go on from

  /// The last iterate of the last phase that ran.
  [[nodiscard]] auto const& x() const { return second ? second->x() : first.x(); }
  /// How the last phase that ran ended.
  [[nodiscard]] slant::status status() const { return second ? second->status : first.status; }
  /// The same as a sentence, for both phases.
  [[nodiscard, gnu::cold]] std::string reason() const {
    return "first phase: " + first.reason +
           (second ? "; second phase: " + second->reason : std::string("; no second phase"));
  }
  /// True only if the second phase reached the accuracy asked for.
  [[nodiscard]] bool converged() const { return second && second->converged(); }
  /// Steps of both phases.
  [[nodiscard]] index iterations() const {
    return first.iterations() + (second ? second->iterations() : 0);
  }
  /// The work of both phases.
  [[nodiscard]] slant::work work() const
    requires requires(First const& f, Second const& s) { f.work, s.work; }
  {
    slant::work sum = first.state.work;
    if (second) sum += second->state.work;
    return sum;
  }
};

namespace detail {

/// What solve_then returns after a static_assert; nothing of it is defined.
template <class V>
struct refused_sequel_report {
  refused_report<V> first;
  std::optional<refused_report<V>> second;
  V const& x() const;
  slant::status status() const;
  [[gnu::cold]] std::string reason() const;
  bool converged() const;
  index iterations() const;
  slant::work work() const;
};

/// The second method: a Second, or what a Second makes of the last state of First.
template <class Second, class State>
[[nodiscard]] decltype(auto) sequel_of(Second& second, State const& last) {
  if constexpr (std::invocable<Second&, State const&>) {
    return second(last);
  } else {
    return (second);
  }
}
template <class Second, class First, class V>
using sequel_t = std::remove_cvref_t<decltype(sequel_of(
    std::declval<std::remove_reference_t<Second>&>(), std::declval<state_t<First, V> const&>()))>;

template <class First, class Stop1, class Second, class V, class Stop2, class... Observers>
concept solvable_in_turn =
    solvable<First, V, Stop1, Observers...> &&
    solvable<sequel_t<Second, First, V>, V, Stop2, Observers...> &&
    std::same_as<std::remove_cvref_t<decltype(std::declval<state_t<First, V> const&>().x)>, V>;

}  // namespace detail

/// Runs the first method from x0 until stop1, and the second, a method or a function that makes one
/// of the last state of the first, from where it ended until stop2; observers see all states of
/// both. A first phase that was stopped by a limit or stalled hands over all the same; after
/// breakdown, unbounded or interrupted, or an iterate that is not finite, there is no second phase
/// and the report says so. Throws what the methods throw about their start.
template <class First, class Stop1, class Second, class V, class Stop2, class... Observers>
  requires detail::solvable_in_turn<First, Stop1, Second, V, Stop2, Observers...>
[[nodiscard]] auto solve_then(First&& first, Stop1 stop1, Second&& second, V const& x0, Stop2 stop2,
                              Observers&&... observers) {
  sequel_report<state_t<First, V>, state_t<detail::sequel_t<Second, First, V>, V>> result{
      slant::solve(first, x0, std::move(stop1), observers...), std::nullopt};
  auto const how = result.first.status;
  bool const failed =
      how == status::breakdown || how == status::unbounded || how == status::interrupted;
  if (!failed && detail::is_finite(slant::norm(result.first.x()))) {
    auto&& next = detail::sequel_of(second, result.first.state);
    result.second = slant::solve(next, result.first.x(), std::move(stop2), observers...);
  }
  return result;
}

/// Arguments that lack something end here and are told so.
template <class First, class Stop1, class Second, class V, class Stop2, class... Observers>
  requires(!detail::solvable_in_turn<First, Stop1, Second, V, Stop2, Observers...>)
[[nodiscard]] auto solve_then(First&&, Stop1, Second&&, V const&, Stop2, Observers&&...)
    -> detail::refused_sequel_report<V> {
  static_assert(iterative_method<First, V>,
                "solve_then: the first method must run on vectors like x0");
  if constexpr (iterative_method<First, V>) {
    using next = detail::sequel_t<Second, First, V>;
    static_assert(iterative_method<next, V>,
                  "solve_then: the second method must run on vectors like x0");
    static_assert(stopping_rule<Stop1, state_t<First, V>>,
                  "solve_then: the first rule must judge states of the first method");
    (detail::check_observer<Observers, state_t<First, V>>(), ...);
    if constexpr (iterative_method<next, V>) {
      static_assert(stopping_rule<Stop2, state_t<next, V>>,
                    "solve_then: the second rule must judge states of the second method");
      (detail::check_observer<Observers, state_t<next, V>>(), ...);
    }
  }
  return {};
}

}  // namespace slant
