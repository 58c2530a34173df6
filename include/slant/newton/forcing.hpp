// SPDX-License-Identifier: MIT
//
// Forcing terms: how accurately the linear system of a Newton step is worth solving. Far from the
// solution the linear model is wrong anyway; near it a tolerance η⁽ᵏ⁾ → 0 keeps superlinear
// convergence [Dembo, Eisenstat, Steihaug 1982].
//
// Intuition. A rule sees numbers only: how large the error is, was, and was at first, and what was
// asked for the last time. So it serves any method with inner iterations.
//
// Minimal definition.   rule(history) → η in (0, 1), relative to ‖F(y⁽ᵏ⁾)‖ or what a method says.
//
// Models. fixed_forcing, adaptive_precision, eisenstat_walker.
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/scalar.hpp>

#include <concepts>

namespace slant {

/// What a forcing rule sees. Errors are norms of residuals in any unit, or relative sizes of steps.
template <class S>
struct forcing_history {
  index iteration = 0;  ///< k, the number of steps made
  S error{1};           ///< err⁽ᵏ⁾, now
  S previous_error{1};  ///< err⁽ᵏ⁻¹⁾; at k = 0 the same as error
  S first_error{1};  ///< err⁽⁰⁾, what the errors are relative to; 1 if they are relative already
  S last_tolerance{1};  ///< η⁽ᵏ⁻¹⁾; at k = 0 without meaning

  /// Nothing done yet, with the error err⁽⁰⁾.
  [[nodiscard]] static forcing_history starting_at(S const& error) {
    return {0, error, error, error, S(1)};
  }
  /// η⁽ᵏ⁾ by the rule, which is remembered as the last tolerance.
  template <class Rule>
  [[nodiscard]] S next(Rule const& rule) {
    last_tolerance = S(rule(std::as_const(*this)));
    return last_tolerance;
  }
  /// A step has been made and left this error.
  void record(S const& new_error) {
    previous_error = error;
    error = new_error;
    ++iteration;
  }
};

/// A rule that says how accurately to solve; see the top of this file.
template <class R, class S>
concept forcing_rule = requires(R const& rule, forcing_history<S> const& h) {
  { rule(h) } -> std::convertible_to<S>;
};

namespace detail {

/// t^e for t ≥ 0 and e ≥ 0, by products and square roots: a scalar need not know pow. The exponent
/// is rounded to 2⁻²⁰.
template <class S>
[[nodiscard]] S power_of(S t, double e) {
  using std::sqrt;
  S result(1);
  auto const whole = static_cast<int>(e);
  for (int i = 0; i < whole; ++i) result *= t;
  double rest = e - whole;
  for (int bit = 0; bit < 20 && rest > 0; ++bit) {
    t = sqrt(t);
    rest *= 2;
    if (rest >= 1) {
      result *= t;
      rest -= 1;
    }
  }
  return result;
}

}  // namespace detail

/// The same η in every step: linear convergence by the factor η at least; 0 asks for all digits.
struct fixed_forcing {
  double tolerance = 0;  ///< η in [0, 1)

  [[gnu::cold]] void validate() const {
    detail::check_option("tolerance", tolerance, tolerance >= 0 && tolerance < 1,
                         "a number in [0, 1)");
  }
  template <class S>
  [[nodiscard]] S operator()(forcing_history<S> const&) const {
    return S(tolerance);
  }
};

/// The adaptive precision control of the documents [T §3.4], [K §3.2.4 (ii), IMSSN (3.1°)]:
///     tol⁽ᵏ⁾ = min(r_tol err⁽ᵏ⁾/err⁽⁰⁾, c_fact tol⁽ᵏ⁻¹⁾),   tol⁽⁻¹⁾ = r_tol / c_fact.
struct adaptive_precision {
  double r_tol = 0.1;   ///< in (0, 1): [K] proposes 0.1, [T] 0.01
  double c_fact = 0.9;  ///< in (0, 1)

  [[gnu::cold]] void validate() const {
    detail::check_fraction("r_tol", r_tol);
    detail::check_fraction("c_fact", c_fact);
  }
  template <class S>
  [[nodiscard]] S operator()(forcing_history<S> const& h) const {
    S const by_error = S(r_tol) * (h.error / h.first_error);
    S const by_count = h.iteration == 0 ? S(r_tol) : S(S(c_fact) * h.last_tolerance);
    return by_error < by_count ? by_error : by_count;
  }
};

/// η⁽ᵏ⁾ = γ (err⁽ᵏ⁾/err⁽ᵏ⁻¹⁾)^exponent, not below γ (η⁽ᵏ⁻¹⁾)^exponent while that is above 0.1, so
/// that one lucky step does not make the next one expensive [Eisenstat, Walker 1996, choice 2].
struct eisenstat_walker {
  double γ = 0.9;        ///< in (0, 1]
  double exponent = 2;   ///< in (1, 2]: the order of convergence, quadratic for 2 if γ < 1
  double η_max = 0.9;    ///< in (0, 1): never less accurate than this
  double η_first = 0.5;  ///< in (0, η_max]: that of the first step
  double goal = 0;  ///< in [0, 1): no step is solved beyond half of goal · err⁽⁰⁾; 0: no limit

  [[gnu::cold]] void validate() const {
    detail::check_option("γ", γ, γ > 0 && γ <= 1, "a number in (0, 1]");
    detail::check_option("exponent", exponent, exponent > 1 && exponent <= 2, "a number in (1, 2]");
    detail::check_fraction("η_max", η_max);
    detail::check_option("η_first", η_first, η_first > 0 && η_first <= η_max,
                         "a number in (0, η_max]");
    detail::check_option("goal", goal, goal >= 0 && goal < 1, "a number in [0, 1)");
  }
  template <class S>
  [[nodiscard]] S operator()(forcing_history<S> const& h) const {
    auto η = S(η_first);
    if (h.iteration > 0) {
      η = S(γ) * detail::power_of(S(h.error / h.previous_error), exponent);
      S const last = S(γ) * detail::power_of(h.last_tolerance, exponent);
      if (last > S(0.1) && η < last) η = last;
    }
    S const enough = S(goal / 2) * (h.first_error / h.error);
    if (η < enough) η = enough;
    return η < S(η_max) ? η : S(η_max);  // also if err has become NaN
  }
};

}  // namespace slant
