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

#include <slant/base/diagnosis.hpp>
#include <slant/base/held.hpp>
#include <slant/base/progress_watch.hpp>
#include <slant/base/report.hpp>
#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/slanting_function.hpp>
#include <slant/newton/direct_solver.hpp>
#include <slant/newton/direction.hpp>
#include <slant/newton/forcing.hpp>
#include <slant/newton/krylov_solvers.hpp>
#include <slant/newton/symmetrized_cg.hpp>
#include <slant/slanting/slanting_part.hpp>

#include <concepts>
#include <string>
#include <type_traits>
#include <utility>

namespace slant {

// --- globalisation -------------------------------------------------------------------------------
//
// Globalisations: how far to go along a Newton direction.
//
// Intuition. Like forcing terms they see numbers only. The method evaluates F(y + α dy) for the
// lengths α that it is told, and keeps the value of the accepted one as its next residual: so a
// length that is accepted at once costs nothing.
//
// Minimal definition.
//     first_length()       the first α
//     accepts(point)       is this the next iterate? Never true of a point where ‖F‖ is not finite
//     next_length(point)   the α to try after a refusal; 0: give up
//
// Models. full_step, halving_line_search.

/// A point tried along a direction.
template <class S>
struct search_point {
  index trial = 0;       ///< 0 for the first length
  S length{1};           ///< α
  S residual{0};         ///< ‖F(y + α dy)‖; NaN and ∞ are possible
  S residual_before{0};  ///< ‖F(y)‖
  S linear_residual{0};  ///< ‖F(y) + F°(y) dy‖
};

/// A rule for the length of Newton steps; see above.
template <class G, class S>
concept globalisation = requires(G const& g, search_point<S> const& p) {
  S(g.first_length());
  { g.accepts(p) } -> std::same_as<bool>;
  { g.next_length(p) } -> std::convertible_to<S>;
};

/// α = 1 always: Newton's method itself. Local convergence.
struct full_step {
  [[nodiscard]] static constexpr int first_length() { return 1; }
  template <class S>
  [[nodiscard]] bool accepts(search_point<S> const& p) const {
    return detail::is_finite(p.residual);
  }
  template <class S>
  [[nodiscard]] S next_length(search_point<S> const&) const {
    return S(0);
  }
};

/// α = 1, ½, ¼, … until ‖F(y + α dy)‖ ≤ ‖F‖ − c α (‖F‖ − ‖F + F° dy‖): a fraction c of the
/// decrease that the linear model promises [Eisenstat, Walker 1994].
///
/// Where F is smooth and F° dy = −F nearly, some α is accepted. At a kink it may be that none is:
/// then the run stalls rather than accept an increase, since a monotone sequence ‖F‖ is all that
/// is known to keep it from cycling.
struct halving_line_search {
  double sufficient = 1e-4;  ///< c in (0, 1)
  index max_halvings = 30;   ///< ≥ 0

  [[gnu::cold]] void validate() const {
    detail::check_fraction("sufficient", sufficient);
    detail::check_option("max_halvings", max_halvings, max_halvings >= 0, "a number >= 0");
  }
  [[nodiscard]] static constexpr int first_length() { return 1; }
  template <class S>
  [[nodiscard]] bool accepts(search_point<S> const& p) const {
    S const promised = p.residual_before - p.linear_residual;
    return p.residual <= p.residual_before - S(sufficient) * p.length * promised;
  }
  template <class S>
  [[nodiscard]] S next_length(search_point<S> const& p) const {
    return p.trial < max_halvings ? S(p.length / S(2)) : S(0);
  }
};

// --- by laws -------------------------------------------------------------------------------------
//
// The linear solver that the laws of F°(y) allow, chosen by the compiler, the first of
//
//     symmetrized_cg      G is symmetrizable: I − P° (I − ρA) with definite A
//     direct_solver       G offers its inverse
//     cg_solver           G is self-adjoint and positive definite
//     direct_solver       G is a matrix, sparse or dense
//     bicgstab_solver     whatever else

/// The default: stands for one of the solvers above, with its default options. What was chosen is
/// visible as a type, chosen_solver_t<by_laws, G, V>.
struct by_laws {
  template <class G, class V>
  using choice = std::conditional_t<
      symmetrizable<G>, symmetrized_cg,
      std::conditional_t<has_inverse<G, V> || (solved_cheaply<G, V> && !spd_operator<G, V>),
                         direct_solver,
                         std::conditional_t<spd_operator<G, V>, cg_solver, bicgstab_solver>>>;

  template <class Solver>
  [[nodiscard]] explicit operator Solver() const {
    return {};
  }
};

/// What ended a run of semismooth_newton, beside success.
enum class newton_failure : unsigned char {
  none,          ///< nothing has
  no_direction,  ///< the linear solver found no dy with ‖F + F° dy‖ < ‖F‖
  not_finite,    ///< F left the range of the scalar where the step leads
  no_length,     ///< no length was accepted by the globalisation
  no_digits,     ///< steps are down to the last digit of y, and ‖F‖ falls no more
  no_progress    ///< ‖F‖ has had no new smallest value for a hundred steps
};

/// State of semismooth_newton for F on vectors V with a solver of type Solver. slant_operator
/// refers to F, so it must not be applied after F is gone; all the rest may be used.
template <class F, class V, class Solver>
struct newton_state {
  using vector_type = V;
  using scalar = scalar_t<V>;
  using slant_type = slant_operator_t<F, V>;

  V x;                                         ///< iterate y
  V residual;                                  ///< F(y)
  slant_type slant_operator;                   ///< F°(y)
  workspace_t<F, V> f_workspace;               ///< temporaries of F
  prepared_t<Solver, slant_type, V> prepared;  ///< what the linear solver keeps
  V direction = residual;                      ///< dy of the last step
  V trial = residual;                          ///< y + α dy
  V trial_residual = residual;                 ///< F(y + α dy)

  scalar residual_norm{0};  ///< ‖F(y)‖
  /// What ‖F(y)‖ is small against: ‖F(0)‖, as ‖b‖ for linear systems; ‖F(y₀)‖ if that is 0 or not
  /// finite.
  scalar residual_scale{0};
  scalar step_norm = detail::infinity<scalar>();  ///< ‖dy‖, or ‖α dy‖ if α > 1: a step
                                                  ///< that was shortened says nothing
                                                  ///< about the distance to go
  scalar x_norm{0};                               ///< ‖y‖
  scalar length{0};                               ///< α of the last step
  scalar linear_residual{0};                      ///< ‖F + F° dy‖ of the last step
  forcing_history<scalar> forcing{};              ///< errors, and η of the last step
  progress_watch<scalar> progress{};              ///< looks for steps that get nowhere

  index inner_iterations = 0;  ///< of the linear solver in the last step
  index trials = 0;            ///< evaluations of F in the last step, 1 without shortening
  index iteration = 0;
  slant::status status = slant::status::running;
  newton_failure failure = newton_failure::none;         ///< why, if status says failure
  slant::status solver_status = slant::status::running;  ///< how the last linear solve ended
  slant::work work{};  ///< operator_applications: evaluations of F and applications of F° or its
                       ///< parts; for a natural residual each is one product by A

  /// Ends the run; false, for callers that return whether they succeeded.
  bool give_up(slant::status how, newton_failure why) {
    status = how;
    failure = why;
    return false;
  }
  /// The same where no step was made: the size of its direction, 0 perhaps, is no sign of success.
  bool give_up_step(slant::status how, newton_failure why) {
    step_norm = detail::infinity<scalar>();
    return give_up(how, why);
  }

  [[nodiscard, gnu::cold]] std::string reason() const {
    switch (failure) {
      case newton_failure::no_direction:
        return "the linear solver found no direction along which F decreases (" +
               std::string(to_string(solver_status)) + "): F° may be singular";
      case newton_failure::not_finite:
        return "F is not finite where the step leads";
      case newton_failure::no_length:
        return "no step length along the Newton direction decreases the residual enough";
      case newton_failure::no_digits:
        return "steps change but the last digits of the iterate, and the residual falls no more";
      case newton_failure::no_progress:
        return "the residual has not fallen for many steps";
      default:
        return status == slant::status::converged ? "the residual vanishes"
                                                  : std::string(to_string(status));
    }
  }
};

// --- parts ---------------------------------------------------------------------------------------
//
// What semismooth_newton asks of its parts, and the answer to parts that lack something; see
// base/diagnosis.hpp. The vectors are not known before start(x0), so that is where most
// of it is asked.

/// F is a slanting function of vectors V, and the other parts can work with it.
template <class F, class V, class LinearSolver, class Globalisation, class Forcing>
concept newton_parts =
    vector<V> && slanting_function<F, V> &&
    direction_solver<chosen_solver_t<LinearSolver, slant_operator_t<F, V>, V>,
                     slant_operator_t<F, V>, V> &&
    globalisation<Globalisation, scalar_t<V>> && forcing_rule<Forcing, scalar_t<V>>;

namespace detail {

template <class D, class G, class V>
concept explains_refusal = requires { D::template refuse<G, V>(); };

/// The complaint about a linear solver; the solvers of the library have their own words.
template <class D, class G, class V>
consteval void refuse_solver() {
  if constexpr (direction_solver<D, G, V>) {
    return;
  } else if constexpr (explains_refusal<D, G, V>) {
    D::template refuse<G, V>();
  } else {
    static_assert(direction_solver<D, G, V>,
                  "semismooth_newton: the linear solver must have prepare and solve for F°(y)");
  }
}

/// One complaint for each part that lacks something.
template <class F, class V, class LinearSolver, class Globalisation, class Forcing>
consteval void refuse_newton_parts() {
  static_assert(vector<V>,
                "semismooth_newton: x0 must be a slant::vector; an expression or a view is none");
  if constexpr (vector<V>) {
    using S = scalar_t<V>;
    static_assert(slanting_function<F, V>,
                  "semismooth_newton: F must be a slanting function of vectors like x0");
    static_assert(globalisation<Globalisation, S>,
                  "semismooth_newton: a globalisation has first_length, accepts and next_length");
    static_assert(forcing_rule<Forcing, S>,
                  "semismooth_newton: a forcing rule takes a forcing_history to a tolerance");
    if constexpr (slanting_function<F, V>) {
      using G = slant_operator_t<F, V>;
      refuse_solver<chosen_solver_t<LinearSolver, G, V>, G, V>();
    }
  }
}

/// Options of a part, if it has any, are checked.
template <class Part>
void validate_part(Part const& part) {
  if constexpr (requires { part.validate(); }) part.validate();
}

/// What start returns then; nothing of it is defined.
template <class V>
struct refused_newton_state : refused_state<V> {};

}  // namespace detail

/// No function at all.
template <class F, class LinearSolver, class Globalisation, class Forcing>
class semismooth_newton : public detail::refused {
  static_assert(slanting_part<F>,
                "semismooth_newton: expected a slanting function, with value(y, f) and slant(y)");

 public:
  template <class... Arguments>
  explicit semismooth_newton(Arguments const&...);
  template <class V>
  detail::refused_newton_state<V> start(V const& x0) const;
  template <class State>
  void step(State& s) const;
};

/// Newton's method: solve(semismooth_newton{F}, y0, residual_below(1e-10) || at_most(100)), or
/// semismooth_newton{F, linear solver, globalisation, forcing rule}.
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
                             Forcing forcing = {})
      : f_(std::move(f)),
        linear_solver_(std::move(linear_solver)),
        search_(std::move(search)),
        forcing_(std::move(forcing)) {
    detail::check_size("F.rows()", index(this->f().rows()), index(this->f().cols()), "F.cols()");
    detail::validate_part(linear_solver_);
    detail::validate_part(search_);
    detail::validate_part(forcing_);
  }

  /// Throws bad_input if x0 or F(x0) is not finite or of the wrong size.
  template <class V>
    requires newton_parts<function_type, V, LinearSolver, Globalisation, Forcing>
  [[nodiscard]] state_for<V> start(V const& x0) const {
    using S = scalar_t<V>;
    detail::check_size("x0", index(slant::local(x0).size()), index(f().cols()), "F.cols()");
    detail::check_finite("x0", x0);
    auto f_workspace = slant::workspace(f(), x0);
    auto residual = like(x0, f().rows());
    slant::evaluate(f(), x0, residual, f_workspace);
    detail::check_finite("F(x0)", residual);
    auto g = slant::slant_from_value(f(), x0, f_workspace);
    auto prepared = solver<V>().prepare(std::as_const(g), std::as_const(residual));
    state_for<V> s{x0, std::move(residual), std::move(g), std::move(f_workspace),
                   std::move(prepared)};
    vectors::set_zero(s.direction);
    ++s.work.operator_applications;
    s.residual_norm = norm(s.residual);
    s.x_norm = norm(s.x);
    set_scale(s);
    s.forcing = forcing_history<S>::starting_at(s.residual_norm);
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
    auto const r =
        solver<V>().solve(std::as_const(s.slant_operator), std::as_const(s.residual),
                          {s.forcing.next(forcing_), s.residual_norm}, s.direction, s.prepared);
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
    bool is_finite_somewhere = false;
    for (p.length = S(search_.first_length()); p.length > S(0);
         p.length = S(search_.next_length(p)), ++p.trial) {
      vectors::waxpy(p.length, s.direction, s.x, s.trial);
      slant::evaluate(f(), s.trial, s.trial_residual, s.f_workspace);
      ++s.work.operator_applications;
      p.residual = norm(s.trial_residual);
      is_finite_somewhere = is_finite_somewhere || detail::is_finite(p.residual);
      s.length = p.length;
      s.trials = p.trial + 1;
      if (search_.accepts(std::as_const(p))) {
        s.residual_norm = p.residual;
        return true;
      }
    }
    return is_finite_somewhere ? s.give_up_step(status::stalled, newton_failure::no_length)
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
    S const before = norm(s.trial_residual);
    s.forcing.record(s.residual_norm);
    if (s.status != status::running) return;
    bool const last_digits = s.step_norm <= S(4) * detail::epsilon<S>() * s.x_norm;
    if (last_digits && !(s.residual_norm < before)) {
      s.give_up(status::stalled, newton_failure::no_digits);
    } else if (constexpr index patience = 100;
               s.progress.stalled(s.iteration, s.residual_norm, patience)) {
      s.give_up(status::stalled, newton_failure::no_progress);
    }
  }

  template <class State>
  void set_scale(State& s) const {
    using S = typename State::scalar;
    s.residual_scale = s.residual_norm;
    if (s.x_norm == S(0)) return;
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
};

template <class F, class LinearSolver = by_laws, class Globalisation = halving_line_search,
          class Forcing = eisenstat_walker>
semismooth_newton(F&&, LinearSolver = {}, Globalisation = {}, Forcing = {})
    -> semismooth_newton<kept_t<F>, LinearSolver, Globalisation, Forcing>;

}  // namespace slant
