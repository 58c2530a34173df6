// SPDX-License-Identifier: MIT
//
// Stopping rules and their algebra: reduced_gradient_below(1e-8) || at_most(500).
//
// A rule looks at a state and answers `running` or a reason to stop. `a || b` stops as soon as one
// of them does and speaks with its voice (that of success, if both do); `a && b` stops when both
// do. Own rules derive from slant::rule to take part in the algebra.
//
// Accuracy is always relative to a scale that the state brings along, so no rule knows units.
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/iterative_method.hpp>

#include <string>
#include <type_traits>
#include <utility>

namespace slant {

/// Base of everything that combines with || and &&.
struct rule {};

template <class R> concept combinable_rule = std::derived_from<std::remove_cvref_t<R>, rule>;

namespace detail {

template <class S>
S checked_tolerance(S tolerance) {
  if (!(tolerance >= S(0)) || !(tolerance < S(1))) {
    throw bad_input("tolerance", show(tolerance), "a relative accuracy in [0, 1)");
  }
  return tolerance;
}

/// What the doors take: a tolerance, and steps to a limit.
template <class S>
void check_limits(S const& tolerance, index max_steps) {
  checked_tolerance(tolerance);
  if (max_steps < 0) throw bad_input("max_steps", show(max_steps), "at least 0");
}

/// converged if size ≤ tolerance · scale; never against a scale that has overflowed.
template <class N, class S>
status is_below(N const& size, S const& tolerance, N const& scale) {
  return size <= tolerance * scale && is_finite(scale) ? status::converged : status::running;
}

// The sentences are made here, once for all types of states.

[[nodiscard, gnu::cold]] inline std::string limit_reached(index limit, char const* of_what) {
  return "reached the limit of " + show(limit) + " " + of_what;
}

template <class N, class S>
[[nodiscard, gnu::cold]] std::string small_beside(char const* what, N const& size, N const& scale,
                                                  S const& tolerance) {
  return std::string("relative ") + what + " " + brief(size) + " / " + brief(scale) +
         " is at most " + show(tolerance);
}

}  // namespace detail

/// Stops after n steps with status iteration_limit. n ≥ 0, else bad_input.
class at_most : public rule {
 public:
  explicit at_most(index n) : limit_(n) {
    if (n < 0) throw bad_input("at_most", detail::show(n), "a number of steps >= 0");
  }
  status operator()(iteration_state auto const& s) const {
    return s.iteration >= limit_ ? status::iteration_limit : status::running;
  }
  [[gnu::cold]] std::string reason(auto const&) const {
    return detail::limit_reached(limit_, "steps");
  }

 private:
  index limit_;
};

template <class State>
concept has_work = requires(State const& s) {
  { s.work.operator_applications } -> std::convertible_to<index>;
};

/// Stops as soon as n applications of A have been spent, with status iteration_limit.
class at_most_applications : public rule {
 public:
  explicit at_most_applications(index n) : limit_(n) {
    if (n < 0) throw bad_input("at_most_applications", detail::show(n), "a number >= 0");
  }
  template <has_work State>
  status operator()(State const& s) const {
    return s.work.operator_applications >= limit_ ? status::iteration_limit : status::running;
  }
  [[gnu::cold]] std::string reason(auto const&) const {
    return detail::limit_reached(limit_, "operator applications");
  }

 private:
  index limit_;
};

template <class State>
concept has_residual_norm = requires(State const& s) { s.residual_norm <= s.residual_scale; };

/// ‖residual‖ ≤ tolerance · scale, for methods whose state has residual_norm and residual_scale.
template <class S>
class residual_below : public rule {
 public:
  explicit residual_below(S tolerance) : tolerance_(detail::checked_tolerance(tolerance)) {}
  template <has_residual_norm State>
  status operator()(State const& s) const {
    return detail::is_below(s.residual_norm, tolerance_, s.residual_scale);
  }
  template <has_residual_norm State>
  [[gnu::cold]] std::string reason(State const& s) const {
    return detail::small_beside("residual", s.residual_norm, s.residual_scale, tolerance_);
  }

 private:
  S tolerance_;
};

template <class State>
concept has_reduced_gradient_norm =
    requires(State const& s) { s.reduced_gradient_norm <= s.gradient_scale; };

/// ‖r̃‖ ≤ tolerance · scale with the reduced gradient r̃ = (x − P(x − αr))/α of [K (30)], which is
/// zero exactly at the solution [K Lemma 2]. The scale is the state's: ‖r̃‖ at P_Λ(0).
template <class S>
class reduced_gradient_below : public rule {
 public:
  explicit reduced_gradient_below(S tolerance) : tolerance_(detail::checked_tolerance(tolerance)) {}
  template <has_reduced_gradient_norm State>
  status operator()(State const& s) const {
    return detail::is_below(s.reduced_gradient_norm, tolerance_, s.gradient_scale);
  }
  template <has_reduced_gradient_norm State>
  [[gnu::cold]] std::string reason(State const& s) const {
    return detail::small_beside("reduced gradient", s.reduced_gradient_norm, s.gradient_scale,
                                tolerance_);
  }

 private:
  S tolerance_;
};

/// Stops when a predicate on the state holds, with the status and the sentence given.
template <class Predicate>
class stop_when : public rule {
 public:
  stop_when(Predicate p, std::string sentence, status why = status::interrupted)
      : predicate_(std::move(p)), sentence_(std::move(sentence)), why_(why) {}
  template <class State>
    requires std::predicate<Predicate const&, State const&>
  status operator()(State const& s) const {
    return predicate_(s) ? why_ : status::running;
  }
  [[gnu::cold]] std::string reason(auto const&) const { return sentence_; }

 private:
  Predicate predicate_;
  std::string sentence_;
  status why_;
};

namespace detail {

template <class A, class B>
struct either_rule : rule {
  A a;
  B b;
  either_rule(A first, B second) : a(std::move(first)), b(std::move(second)) {}
  template <class State>
    requires stopping_rule<A, State> && stopping_rule<B, State>
  status operator()(State const& s) {
    auto const first = a(s);
    auto const second = b(s);  // always asked: a rule may keep a history
    // Success in the last permitted step is success.
    fired_first_ =
        first != status::running && (first == status::converged || second != status::converged);
    return fired_first_ ? first : second;
  }
  template <class State>
  [[gnu::cold]] std::string reason(State const& s) const {
    return fired_first_ ? a.reason(s) : b.reason(s);
  }

 private:
  bool fired_first_ = false;
};

template <class A, class B>
struct both_rule : rule {
  A a;
  B b;
  both_rule(A first, B second) : a(std::move(first)), b(std::move(second)) {}
  template <class State>
    requires stopping_rule<A, State> && stopping_rule<B, State>
  status operator()(State const& s) {
    auto const first = a(s);
    auto const second = b(s);
    if (first == status::running || second == status::running) return status::running;
    return first == status::converged ? second : first;  // the less happy of the two
  }
  template <class State>
  [[gnu::cold]] std::string reason(State const& s) const {
    return a.reason(s) + " and " + b.reason(s);
  }
};

/// One of the two is a rule and the other is none.
template <class A, class B> concept halfway_combinable = combinable_rule<A> != combinable_rule<B>;

/// The sentence about it; the rest of the program sees the one that is a rule.
template <class A, class B>
[[nodiscard]] auto refused_combination(A a, B b) {
  using other = std::conditional_t<combinable_rule<A>, B, A>;
  static_assert(combinable_rule<other>,
                "an own stopping rule must derive from slant::rule to be combined by || and &&");
  if constexpr (combinable_rule<A>) {
    return a;
  } else {
    return b;
  }
}

}  // namespace detail

template <class A, class B>
  requires detail::halfway_combinable<A, B>
[[nodiscard]] auto operator||(A a, B b) {
  return detail::refused_combination(std::move(a), std::move(b));
}
template <class A, class B>
  requires detail::halfway_combinable<A, B>
[[nodiscard]] auto operator&&(A a, B b) {
  return detail::refused_combination(std::move(a), std::move(b));
}

/// Stops when one of the two does.
template <combinable_rule A, combinable_rule B>
[[nodiscard]] auto operator||(A a, B b) {
  return detail::either_rule<A, B>{std::move(a), std::move(b)};
}

/// Stops when both do.
template <combinable_rule A, combinable_rule B>
[[nodiscard]] auto operator&&(A a, B b) {
  return detail::both_rule<A, B>{std::move(a), std::move(b)};
}

// --- feasible ------------------------------------------------------------------------------------
//
// A stopping rule for methods whose iterates satisfy equality constraints only in the limit. It
// says nothing about optimality: reduced_gradient_below(1e-8) && feasibility_below(1e-8).

template <class State>
concept has_feasibility_norm =
    requires(State const& s) { s.feasibility_norm <= s.feasibility_scale; };

/// ‖G x − e‖ ≤ tolerance · scale, for methods whose state has feasibility_norm and
/// feasibility_scale.
template <class S>
class feasibility_below : public rule {
 public:
  explicit feasibility_below(S tolerance) : tolerance_(detail::checked_tolerance(tolerance)) {}
  template <has_feasibility_norm State>
  status operator()(State const& s) const {
    return detail::is_below(s.feasibility_norm, tolerance_, s.feasibility_scale);
  }
  template <has_feasibility_norm State>
  [[gnu::cold]] std::string reason(State const& s) const {
    return detail::small_beside("distance from the equality constraints", s.feasibility_norm,
                                s.feasibility_scale, tolerance_);
  }

 private:
  S tolerance_;
};

// --- step below ----------------------------------------------------------------------------------
//
// A stopping rule for methods of Newton's kind: their steps are as small as the error was before
// them. ‖dy‖ says more about y than ‖F(y)‖ where F is badly scaled, and less where the steps are
// small for another reason.

template <class State>
concept has_step_norm = requires(State const& s) { s.step_norm <= s.x_norm; };

/// ‖y⁺ − y‖ ≤ tolerance · (‖y⁺‖ + offset), for methods whose state has step_norm (that of a whole
/// step, infinite before the first) and x_norm. Without an offset as in [K §3.2]; [T (SSNM)] has 1,
/// which has the unit of y and makes small solutions look exact.
template <class S>
class step_below : public rule {
 public:
  explicit step_below(S tolerance, S offset = S(0))
      : tolerance_(detail::checked_tolerance(tolerance)), offset_(offset) {
    if (!(offset >= S(0)) || !detail::is_finite(offset)) {
      throw bad_input("offset", detail::show(offset), "a number >= 0, in units of y");
    }
  }
  template <has_step_norm State>
  status operator()(State const& s) const {
    using N = std::remove_cvref_t<decltype(s.x_norm)>;
    return detail::is_below(s.step_norm, tolerance_, N(s.x_norm + N(offset_)));
  }
  template <has_step_norm State>
  [[gnu::cold]] std::string reason(State const& s) const {
    std::string text = "relative step " + detail::brief(s.step_norm) + " / ";
    text += offset_ == S(0) ? detail::brief(s.x_norm)
                            : "(" + detail::brief(s.x_norm) + " + " + detail::show(offset_) + ")";
    return text + " is at most " + detail::show(tolerance_);
  }

 private:
  S tolerance_;
  S offset_;
};

}  // namespace slant
