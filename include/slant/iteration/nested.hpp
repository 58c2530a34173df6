// SPDX-License-Identifier: MIT
//
// Nested iteration: the solution on a coarse mesh starts the next finer one.
//
//     level 0        x₀ = solve(method₀, start, stop₀)
//     level l > 0    x_l = solve(method_l, P_l x_{l−1}, stop_l)        P_l the prolongation
//
// A Newton method needs more steps the further its start is away, and from a fixed start this grows
// with the number of unknowns; from the prolonged solution it does not (mesh independence).
//
// Minimal definition of a level:
//     method()         an iterative method, or a reference to one
//     stop()           the stopping rule of this level
//     prolongation()   a linear operator from vectors of the level before to vectors of this one;
//                      the first level is not asked
// Levels come as a range and are taken one at a time: a range that makes them as it goes
// (std::views::transform) never holds two problems, or two factorisations, at once.
//
// Rejected: an array of methods and an array of operators, which would all have to live at once and
// to be counted against each other. Rejected: a restriction and corrections from coarse to fine
// (multigrid): inequalities need not hold on another mesh, and a start need not be feasible, since
// methods project it.
#pragma once

#include <slant/concepts/linear_operator.hpp>
#include <slant/iteration/solve.hpp>

#include <concepts>
#include <iterator>
#include <type_traits>
#include <utility>
#include <vector>

namespace slant {

template <class L> concept has_method = requires(L& level) { level.method(); };
template <class L> concept has_stop = requires(L& level) { level.stop(); };
template <class L> concept has_prolongation = requires(L& level) { level.prolongation(); };

namespace detail {

template <class L>
using method_of = std::remove_cvref_t<decltype(std::declval<L&>().method())>;
template <class L>
using stop_of = std::remove_cvref_t<decltype(std::declval<L&>().stop())>;
template <class L>
using prolongation_of = std::remove_cvref_t<decltype(std::declval<L&>().prolongation())>;

template <class L, class V>
using level_state = state_t<method_of<L>, V>;

}  // namespace detail

/// The method of a level runs from vectors of type V and its iterates are such vectors.
template <class L, class V>
concept has_method_for = has_method<L> && iterative_method<detail::method_of<L>, V> &&
                         std::same_as<decltype(detail::level_state<L, V>::x), V>;

/// One level for vectors of type V; see the top of this file.
template <class L, class V>
concept nested_level = vector<V> && has_method_for<L, V> && has_stop<L> &&
                       stopping_rule<detail::stop_of<L>, detail::level_state<L, V>> &&
                       has_prolongation<L> && linear_operator<detail::prolongation_of<L>, V>;

/// What solve_nested leaves behind.
template <class State>
struct nested_report {
  std::vector<report<State>> levels;  ///< of every level that was solved, coarsest first

  /// The last iterate of the finest level that was solved.
  [[nodiscard]] auto const& x() const { return levels.back().x(); }
  /// The last report; its status is that of the whole.
  [[nodiscard]] report<State> const& finest() const { return levels.back(); }
  /// True only if the finest level reached the accuracy asked for.
  [[nodiscard]] bool converged() const { return levels.back().converged(); }
};

namespace detail {

/// What solve_nested returns after a static_assert; nothing of it is defined.
template <class V>
struct refused_nested_report : refused_report<V> {
  std::vector<refused_report<V>> levels;
  refused_report<V> const& finest() const;
};

/// What `for (auto&& level : levels)` needs. Not std::ranges::input_range: <ranges> is a tenth of a
/// small program.
template <class Levels>
concept range_of_levels = requires(Levels& levels) {
  *std::begin(levels);
  { std::begin(levels) != std::end(levels) } -> std::convertible_to<bool>;
};
template <class Levels>
using level_of = std::remove_reference_t<decltype(*std::begin(std::declval<Levels&>()))>;

template <class Levels, class V, class... Observers>
concept nested_solvable = range_of_levels<Levels> && nested_level<level_of<Levels>, V> &&
                          (observer<Observers, level_state<level_of<Levels>, V>> && ...);

}  // namespace detail

/// Solves level after level, each from the prolonged last iterate of the one before; observers see
/// all states of all levels. A level that did not converge is no reason to stop: what it reached is
/// a start as well. Only after an iterate that is not finite there is no next level, and the report
/// ends with that one. Throws bad_input if there is no level, if a prolongation does not fit the
/// levels it connects, and whatever the methods throw about their start.
template <class Levels, class V, class... Observers>
  requires detail::nested_solvable<Levels, V, Observers...>
[[nodiscard]] auto solve_nested(Levels&& levels, V const& x0, Observers&&... observers) {
  using level_type = detail::level_of<Levels>;
  nested_report<detail::level_state<level_type, V>> result;
  for (auto&& level : levels) {
    if (result.levels.empty()) {
      result.levels.push_back(slant::solve(level.method(), x0, level.stop(), observers...));
      continue;
    }
    V const& coarse = result.levels.back().state.x;
    if (!detail::is_finite(norm(coarse))) break;
    auto const& P = level.prolongation();
    V start = slant::like(coarse, index(P.rows()));
    slant::apply(P, coarse, start);
    result.levels.push_back(slant::solve(level.method(), start, level.stop(), observers...));
  }
  if (result.levels.empty()) throw bad_input("levels", "none", "at least one level");
  return result;
}

/// Arguments that lack something end here and are told so.
template <class Levels, class V, class... Observers>
  requires(!detail::nested_solvable<Levels, V, Observers...>)
[[nodiscard]] auto solve_nested(Levels&&, V const&, Observers&&...)
    -> detail::refused_nested_report<V> {
  static_assert(detail::range_of_levels<Levels>, "solve_nested: expected a range of levels");
  if constexpr (detail::range_of_levels<Levels>) {
    using level_type = detail::level_of<Levels>;
    static_assert(has_method<level_type> && has_stop<level_type> && has_prolongation<level_type>,
                  "solve_nested: a level must have method(), stop() and prolongation()");
    if constexpr (has_method<level_type> && has_stop<level_type> && has_prolongation<level_type>) {
      static_assert(has_method_for<level_type, V>,
                    "solve_nested: the method of a level must run on vectors like x0");
      static_assert(linear_operator<detail::prolongation_of<level_type>, V>,
                    "solve_nested: a prolongation must be a linear operator on vectors like x0");
      if constexpr (has_method_for<level_type, V>) {
        using state = detail::level_state<level_type, V>;
        static_assert(stopping_rule<detail::stop_of<level_type>, state>,
                      "solve_nested: the rule must judge states of the level's method");
        (detail::check_observer<Observers, state>(), ...);
      }
    }
  }
  return {};
}

}  // namespace slant
