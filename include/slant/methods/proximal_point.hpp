// SPDX-License-Identifier: MIT
//
// The proximal point method for 0 ∈ T(x) where T is singular or badly conditioned [Rockafellar,
// "Monotone operators and the proximal point algorithm", 1976]:
//
//     x⁺ solves  0 ∈ T(x⁺) + α Λ (x⁺ − x),     Λ a positive definite weight of the inner solver's
//
// Every inner problem is better conditioned than the last would be without α, and no bias is left
// at the end. α follows the inner solver: smaller when that was quick, larger when it failed. For T
// that is not monotone, such as Coulomb friction, the steps follow a path where Newton's method on
// T itself has none, and α is as small as there is a solution nearby (Acary, Brémond and Huber, "On
// solving contact problems with Coulomb friction: formulations and numerical comparisons", 2018,
// find it the most robust method at high accuracy).
#pragma once

#include <slant/base/report.hpp>
#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/iterative_method.hpp>
#include <slant/concepts/vector.hpp>

#include <algorithm>
#include <concepts>
#include <limits>
#include <utility>

namespace slant {

/// What an inner solver reports.
struct proximal_inner_report {
  bool solved = false;  ///< accurate enough: the step is made and α may become smaller
  bool accept = false;  ///< not solved, but x is better than the centre: the step is made, α grows
  index steps = 0;      ///< its work, in its own steps
};

template <class Inner, class V>
concept has_proximal_call = requires(Inner& inner, V const& center, scalar_t<V> const& α, V& x) {
  { inner(center, α, x) } -> std::same_as<proximal_inner_report>;
};

/// Options of proximal_point; measured with the friction problems of benchmarks/.
template <scalar S = double>
struct proximal_point_options {
  S first = S(1e-3);      ///< α of the first step
  S smallest = S(1e-14);  ///< least α
  S largest = S(1e8);     ///< a failure at this α means breakdown
  index quick = 4;        ///< inner steps at most: α ← fast · α
  index fair = 10;        ///< inner steps at most: α ← slow · α; beyond: unchanged
  S fast = S(0.1);        ///< in (0, 1]
  S slow = S(0.3);        ///< in (0, 1]
  S growth = S(5);        ///< > 1; α ← growth · α after a failure

  /// Throws bad_input naming the option, its value and what was expected.
  [[gnu::cold]] void validate() const {
    require_positive("first", first);
    require_positive("smallest", smallest);
    require_positive("largest", largest);
    if (!(smallest <= first && first <= largest)) {
      throw bad_input("first", detail::show(first),
                      "a number between smallest, " + detail::show(smallest) + ", and largest, " +
                          detail::show(largest));
    }
    if (quick < 0) throw bad_input("quick", detail::show(quick), "a number >= 0");
    if (fair < quick) throw bad_input("fair", detail::show(fair), "a number >= quick");
    require_fraction("fast", fast);
    require_fraction("slow", slow);
    if (!(growth > S(1)) || !detail::is_finite(growth)) {
      throw bad_input("growth", detail::show(growth), "a finite number > 1");
    }
  }

 private:
  static void require_positive(char const* name, S const& value) {
    if (!(value > S(0)) || !detail::is_finite(value)) {
      throw bad_input(name, detail::show(value), "a finite number > 0");
    }
  }
  static void require_fraction(char const* name, S const& value) {
    if (!(value > S(0) && value <= S(1))) {
      throw bad_input(name, detail::show(value), "a number in (0, 1]");
    }
  }
};

/// State of proximal_point.
template <class V>
struct proximal_point_state {
  using scalar = scalar_t<V>;
  V x;                 ///< the iterate
  V trial;             ///< where the inner solver works
  scalar α{};          ///< of the next step
  scalar step_norm{};  ///< ‖x⁺ − x‖ of the last step that was made
  index iteration = 0;
  index failures = 0;  ///< steps whose inner problem was not solved
  slant::status status = slant::status::running;
  slant::work work{};  ///< inner_iterations: steps of the inner solver
};

/// The method at the top of this file: solve(proximal_point{inner}, x0, rule). `inner(center, α,
/// x)` finds x, which holds the centre at first; it is called with the state's vectors, nothing is
/// allocated. Status of its own: breakdown (an inner problem with α = largest was not solved).
template <class Inner, class S = double>
class proximal_point {
 public:
  explicit proximal_point(Inner inner, proximal_point_options<S> options = {})
      : inner_(std::forward<Inner>(inner)), options_(options) {
    options_.validate();
  }

  template <class V>
    requires has_proximal_call<Inner, V>
  [[nodiscard]] proximal_point_state<V> start(V const& x0) const {
    detail::check_finite("x0", x0);
    return {.x = x0, .trial = x0, .α = options_.first};
  }

  template <class V>
    requires has_proximal_call<Inner, V>
  void step(proximal_point_state<V>& s) {
    if (s.status != status::running) return;
    vectors::copy(s.x, s.trial);
    proximal_inner_report const r = inner_(std::as_const(s.x), std::as_const(s.α), s.trial);
    s.work.inner_iterations += r.steps;
    ++s.iteration;
    if (r.solved || r.accept) {
      using std::swap;
      swap(s.x, s.trial);
      vectors::subtract(s.x, s.trial);
      s.step_norm = norm(s.trial);
    }
    if (r.solved) {
      S const factor = r.steps <= options_.quick  ? options_.fast
                       : r.steps <= options_.fair ? options_.slow
                                                  : S(1);
      s.α = std::max(options_.smallest, S(s.α * factor));
    } else {
      ++s.failures;
      if (s.α >= options_.largest) {
        s.status = status::breakdown;
      } else {
        s.α = std::min(options_.largest, S(s.α * options_.growth));
      }
    }
  }

  [[nodiscard]] Inner& inner() { return inner_; }

 private:
  Inner inner_;  // may be a reference
  proximal_point_options<S> options_;
};

}  // namespace slant
