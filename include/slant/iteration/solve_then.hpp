// SPDX-License-Identifier: MIT
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
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/iteration/solve.hpp>

#include <concepts>
#include <optional>
#include <string>
#include <utility>

namespace slant {

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
    if (second) {
      auto const& more = second->state.work;
      sum.operator_applications += more.operator_applications;
      sum.setup_applications += more.setup_applications;
      sum.inner_iterations += more.inner_iterations;
      sum.factorizations += more.factorizations;
    }
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
