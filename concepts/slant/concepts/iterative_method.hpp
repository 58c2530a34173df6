// SPDX-License-Identifier: MIT
//
// Iterative methods, stopping rules, observers: three things that know nothing of each other.
//
// Intuition. A method turns a state into the next one. It knows no printing, no timing and no
// stopping; a rule looks at a state and says whether to go on; an observer looks at it and leaves.
//
// Minimal definition.
//     method    start(x0) → state,   step(state)
//     state     x, iteration, status (running until the method itself cannot or need not go on)
//     rule      rule(state) → status: running to go on, anything else is the reason to stop,
//               reason(state) → std::string, asked only after it has fired;
//               derived from slant::rule (slant/iteration/stopping.hpp) to combine by || and &&
//     observer  observer(state)
// and, for methods that update a residual where it could be computed from x,
//     method    refresh(state) → bool: computes it; whether there was anything to do
// or that can go on after the data of the problem have changed:
//     method    resume(state, x0)
// or whose statuses want a sentence:
//     state     reason() → std::string: what a status other than running means here
//
// Options of the library's methods are aggregates; validate() throws bad_input naming the option,
// its value and what was expected.
//
// Laws.   start gives iteration 0; step adds 1 to it, or sets a status other than running;
//         a step from a state at rest changes nothing; refresh leaves x alone, and a second one
//         returns false.
//
// Models. slant::cg, slant::kprgp, …; slant::at_most, …; slant::history, ….
#pragma once

#include <slant/concepts/scalar.hpp>

#include <concepts>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace slant {

/// How a run stands or ended.
enum class status : unsigned char {
  running,          ///< more steps are possible and wanted
  converged,        ///< the accuracy asked for, or an exact solution, is reached
  iteration_limit,  ///< a limit on the work was reached first
  stalled,          ///< no further progress is possible at this precision
  unbounded,        ///< the function decreases for ever along a direction of the set
  breakdown,        ///< a quantity left the range of the scalar, or a law was found broken
  interrupted       ///< an observer or rule of the caller asked to stop
};

/// The status in words.
[[nodiscard]] constexpr std::string_view to_string(status s) {
  constexpr std::string_view names[] = {"running",   "converged", "iteration_limit", "stalled",
                                        "unbounded", "breakdown", "interrupted"};
  return s <= status::interrupted ? names[static_cast<int>(s)] : "unknown";
}

template <class State> concept has_iterate = requires(State const& s) { s.x; };
template <class State>
concept has_iteration_count = requires(State const& s) {
  { s.iteration } -> std::convertible_to<index>;
};
template <class State>
concept has_status = requires(State const& s) {
  { s.status } -> std::convertible_to<slant::status>;
};
/// What every method keeps; see the top of this file.
template <class State>
concept iteration_state = has_iterate<State> && has_iteration_count<State> && has_status<State>;

template <class M, class V> concept has_start = requires(M& m, V const& x0) { m.start(x0); };

/// The state of a method started from a vector of type V.
template <class M, class V>
using state_t = std::remove_cvref_t<decltype(std::declval<M&>().start(std::declval<V const&>()))>;

template <class M, class V> concept has_step = requires(M& m, state_t<M, V>& s) { m.step(s); };

/// An iterative method for vectors of type V; see the top of this file.
template <class M, class V>
concept iterative_method = has_start<M, V> && has_step<M, V> && iteration_state<state_t<M, V>>;

/// The method can compute its residual from x; see the top of this file.
template <class M, class State>
concept has_refresh = requires(M& m, State& s) {
  { m.refresh(s) } -> std::same_as<bool>;
};

/// The method can begin anew at x0 in a state that it has made, after the data of its problem have
/// changed: what does not depend on them (all memory, bounds of A) stays.
template <class M, class State, class V>
concept has_resume_at = requires(M const& m, State& s, V const& x0) { m.resume(s, x0); };

template <class R, class State>
concept has_verdict = requires(R& r, State const& s) {
  { r(s) } -> std::same_as<slant::status>;
};
template <class R, class State>
concept has_reason = requires(R const& r, State const& s) {
  { r.reason(s) } -> std::convertible_to<std::string>;
};
/// A rule that says when to stop and why.
template <class R, class State>
concept stopping_rule = has_verdict<R, State> && has_reason<R, State>;

/// Anything that can be shown a state.
template <class O, class State> concept observer = requires(O& o, State const& s) { o(s); };

}  // namespace slant
