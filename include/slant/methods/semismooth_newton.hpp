// SPDX-License-Identifier: MIT
//
// Newton's method for F(y) = 0 with a slanting function F: Rⁿ → Rⁿ [T Algorithm SSNM, Theorem 1.2],
// [K §3.3, Theorem 5]; classical Newton where F is smooth and F° = F′:
//
//     residual     F(y)                                        kept from the last step
//     classify     F°(y), a linear operator
//     solve        ‖F(y) + F°(y) dy‖ ≤ η ‖F(y)‖                linear solver, forcing term η
//     shorten      α with an acceptable F(y + α dy)            globalisation
//     accept       y ← y + α dy
//
// Locally superlinear if F°(y)⁻¹ is bounded near the solution, α = 1 and η → 0; quadratic if F is
// smooth with a Lipschitz derivative and η = O(‖F‖).
//
// Work. One evaluation of F a step and one more for each halving, the first of which is the next
// residual; and what the linear solver spends. For a natural residual that is, in products by A,
// 2 + (iterations of CG) with symmetrized_cg: F, the right-hand side, CG. A function knows nothing
// of the products that a solver forms; a method that knows A, b and the set needs 1 + iterations,
// however often it halves, since A (x + α dx) follows from those of CG.
#pragma once

#include <slant/concepts/checks.hpp>
#include <slant/concepts/vector_algebra.hpp>
#include <slant/methods/newton_options.hpp>
#include <slant/methods/newton_parts.hpp>
#include <slant/methods/newton_state.hpp>
#include <slant/newton/by_laws.hpp>
#include <slant/newton/globalisation.hpp>
#include <slant/operators/held.hpp>
#include <slant/slanting/slanting_base.hpp>

#include <limits>
#include <type_traits>
#include <utility>

namespace slant {

/// Newton's method: solve(semismooth_newton{F}, y0, residual_below(1e-10) || at_most(100)), or
/// semismooth_newton{F, linear solver, globalisation, forcing rule, options}.
/// Requires slanting_function<F, V> for the vectors V of the start and a linear solver that can
/// handle F°(y). Statuses of its own, with state.failure and state.reason(): converged (F(y) = 0);
/// breakdown (no direction, as where F°(y) is singular; F not finite); stalled (no length is
/// acceptable, or ‖F‖ falls no more). F is referenced if it is an lvalue.
template <class F, class LinearSolver, class Globalisation, class Forcing>
  requires slanting_part<F>
class semismooth_newton<F, LinearSolver, Globalisation, Forcing> {
 public:
  using function_type = std::remove_cvref_t<F>;
  /// The linear solver for vectors V: LinearSolver, or what it leaves to the laws of F°(y).
  template <class V>
  using solver_for = chosen_solver_t<LinearSolver, slant_operator_t<function_type, V>, V>;
  template <class V>
  using state_for = newton_state<function_type, V, solver_for<V>>;

  /// Throws bad_input if F has not as many values as arguments, or for options out of range.
  explicit semismooth_newton(held<F> f, LinearSolver linear_solver = {}, Globalisation search = {},
                             Forcing forcing = {}, newton_options options = {})
      : f_(std::move(f)),
        linear_solver_(std::move(linear_solver)),
        search_(std::move(search)),
        forcing_(std::move(forcing)),
        options_(options) {
    detail::check_size("F.rows()", index(this->f().rows()), index(this->f().cols()), "F.cols()");
    detail::validate_part(linear_solver_);
    detail::validate_part(search_);
    detail::validate_part(forcing_);
    options_.validate();
  }

  /// Throws bad_input if x0 or F(x0) is not finite or of the wrong size.
  template <class V>
    requires newton_parts<function_type, V, LinearSolver, Globalisation, Forcing>
  [[nodiscard]] state_for<V> start(V const& x0) const {
    using S = scalar_t<V>;
    detail::check_size("x0", index(slant::local(x0).size()), index(f().cols()), "F.cols()");
    detail::check_finite("x0", x0);
    auto blank = [&] { return like(x0, f().rows()); };
    auto f_workspace = slant::workspace(f(), x0);
    auto residual = blank();
    slant::evaluate(f(), x0, residual, f_workspace);
    detail::check_finite("F(x0)", residual);
    auto g = slant::slant_from_value(f(), x0, f_workspace);
    auto prepared = solver<V>().prepare(std::as_const(g), std::as_const(residual));
    state_for<V> s{x0,
                   std::move(residual),
                   blank(),
                   blank(),
                   blank(),
                   std::move(g),
                   std::move(f_workspace),
                   std::move(prepared)};
    vectors::set_zero(s.direction);
    ++s.work.operator_applications;
    s.residual_norm = norm(s.residual);
    s.x_norm = norm(s.x);
    set_scale(s);
    s.forcing = forcing_history<S>::starting_at(
        options_.error == newton_error::residual ? s.residual_norm : S(1));
    if (s.residual_norm == S(0)) s.status = status::converged;
    return s;
  }

  /// Parts that cannot work together are told so here.
  template <class V>
  [[nodiscard]] detail::refused_newton_state<V> start(V const&) const {
    detail::refuse_newton_parts<function_type, V, LinearSolver, Globalisation, Forcing>();
    return {};
  }
  template <class V>
  void step(detail::refused_newton_state<V>&) const {}

  /// One step, as at the top of this file.
  template <class V, class Solver>
  void step(newton_state<function_type, V, Solver>& s) const {
    if (s.status != status::running) return;
    if (!solve(s) || !shorten(s)) return;
    accept(s);
    note_progress(s);
  }

 private:
  [[nodiscard]] function_type const& f() const { return f_.get(); }
  template <class V>
  [[nodiscard]] solver_for<V> solver() const {
    return static_cast<solver_for<V>>(linear_solver_);
  }

  /// dy with ‖F + F° dy‖ ≤ η ‖F‖; false if there is none that is of use.
  template <class State>
  bool solve(State& s) const {
    using S = typename State::scalar;
    using V = typename State::vector_type;
    S const leftover = s.length < S(1) && s.iteration > 0 ? S(1) - s.length : S(0);
    auto const r = solver<V>().solve(std::as_const(s.slant_operator), std::as_const(s.residual),
                                     {s.forcing.next(forcing_), s.residual_norm, leftover},
                                     s.direction, s.prepared);
    s.linear_residual = r.residual_norm;
    s.solver_status = r.status;
    s.inner_iterations = r.iterations;
    s.work.inner_iterations += r.iterations;
    s.work.operator_applications += r.operator_applications;
    s.work.factorizations += r.factorizations;
    // However the solver ended: what reduces the linear model is an inexact Newton direction, only
    // a less accurate one, if η stays away from 1. A gain near rounding level may come from a
    // vector of any size in the kernel of F°.
    s.step_norm = norm(s.direction);
    bool const useful =
        detail::is_finite(s.step_norm) &&
        (r.status == status::converged || r.residual_norm <= S(0.99) * s.residual_norm);
    return useful || s.give_up_step(status::breakdown, newton_failure::no_direction);
  }

  /// The trial point and its residual; false if no length is accepted.
  template <class State>
  bool shorten(State& s) const {
    using S = typename State::scalar;
    search_point<S> p;
    p.residual_before = s.residual_norm;
    p.linear_residual = s.linear_residual;
    p.best_residual = std::numeric_limits<S>::infinity();
    for (p.length = S(search_.first_length()); p.length > S(0);
         p.length = S(search_.next_length(p)), ++p.trial) {
      vectors::waxpy(p.length, s.direction, s.x, s.trial);
      slant::evaluate(f(), s.trial, s.trial_residual, s.f_workspace);
      ++s.work.operator_applications;
      p.residual = norm(s.trial_residual);
      if (p.residual < p.best_residual) {
        p.best_residual = p.residual;
        p.best_length = p.length;
      }
      s.length = p.length;
      s.trials = p.trial + 1;
      if (search_.accepts(std::as_const(p))) {
        s.residual_norm = p.residual;
        return true;
      }
    }
    return p.best_length > S(0) ? s.give_up_step(status::stalled, newton_failure::no_length)
                                : s.give_up_step(status::breakdown, newton_failure::not_finite);
  }

  /// The trial point becomes the iterate: its F is known, so F° is all that is to be computed.
  template <class State>
  void accept(State& s) const {
    using S = typename State::scalar;
    using std::swap;
    swap(s.x, s.trial);
    swap(s.residual, s.trial_residual);
    s.x_norm = norm(s.x);
    if (s.length > S(1)) s.step_norm *= s.length;
    ++s.iteration;
    if (s.residual_norm == S(0)) {
      s.status = status::converged;
    } else {
      slant::update_slant_after_value(f(), s.x, s.slant_operator, s.f_workspace);
    }
  }

  template <class State>
  void note_progress(State& s) const {
    using S = typename State::scalar;
    S const infinity = std::numeric_limits<S>::infinity();
    S const before = norm(s.trial_residual);
    s.forcing.record(options_.error == newton_error::residual
                         ? s.residual_norm
                         : S(s.step_norm / (s.x_norm + S(options_.step_offset))));
    if (s.status != status::running) return;
    bool const last_digits = s.step_norm <= S(4) * std::numeric_limits<S>::epsilon() * s.x_norm;
    if (last_digits && !(s.residual_norm < before)) {
      s.give_up(status::stalled, newton_failure::no_digits);
    } else if (s.progress.stalled(s.iteration, s.residual_norm, options_.patience,
                                  [&] { return std::pair(infinity, S(0)); })) {
      s.give_up(status::stalled, newton_failure::no_progress);
    }
  }

  template <class State>
  void set_scale(State& s) const {
    using S = typename State::scalar;
    s.residual_scale = s.residual_norm;
    if (options_.scale == newton_scale::start || s.x_norm == S(0)) return;
    vectors::set_zero(s.trial);
    auto w = s.f_workspace;  // that of the state holds what belongs to x0
    slant::evaluate(f(), s.trial, s.trial_residual, w);
    ++s.work.setup_applications;
    S const at_origin = norm(s.trial_residual);
    if (at_origin > S(0) && detail::is_finite(at_origin)) s.residual_scale = at_origin;
  }

  held<F> f_;
  LinearSolver linear_solver_;
  Globalisation search_;
  Forcing forcing_;
  newton_options options_;
};

template <class F, class LinearSolver = by_laws, class Globalisation = halving_line_search,
          class Forcing = eisenstat_walker>
semismooth_newton(F&&, LinearSolver = {}, Globalisation = {}, Forcing = {}, newton_options = {})
    -> semismooth_newton<kept_t<F>, LinearSolver, Globalisation, Forcing>;

}  // namespace slant
