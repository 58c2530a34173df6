// SPDX-License-Identifier: MIT
//
// Linear solvers of Newton's method: from G = F°(y) and F(y) to a direction.
//
// Intuition. A solver is asked for dy with ‖F + G dy‖ ≤ η ‖F‖ and says how far it came. It throws
// nothing and returns no NaN: what cannot be solved is a status, and dy then the best there was.
//
// Minimal definition.
//     prepare(G, F)                  a copyable value that holds all that solves with operators
//                                    like G need; it may keep things from one solve to the next
//     solve(G, F, request, dy, p)    dy and a direction_report; dy is overwritten; no allocation
//                                    (factorisations excepted)
// Both are constrained: a solver has no solve for operators that it cannot handle.
// Optional:
//     choice<G, V>                   a type: the solver stands for another one, made of it by
//                                    static_cast, as by_laws does
//     refuse<G, V>()                 a complaint, at compile time, about operators it cannot take
//
// Laws.   report.residual_norm = ‖F + G dy‖ up to rounding;   converged ⇒ it is ≤ η ‖F‖.
//
// Why increments. [T Remark 3.1] starts the inner iteration for the new multipliers z⁺ from the old
// z. For the increment dz = z⁺ − z that is the start from zero, which is what solvers here do.
//
// Models. symmetrized_cg, cg_solver, bicgstab_solver, direct_solver, sparse_direct_solver, by_laws.
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/iterative_method.hpp>
#include <slant/concepts/vector.hpp>

#include <concepts>
#include <utility>

namespace slant {

/// What is asked of a linear solver.
template <class S>
struct direction_request {
  S tolerance{0};      ///< η in [0, 1); 0: as accurate as can be
  S residual_norm{0};  ///< ‖F‖, finite and > 0
};

/// What a linear solver did.
template <class S>
struct direction_report {
  slant::status status = slant::status::running;  ///< converged, or why it was given up
  S residual_norm{0};                             ///< ‖F + G dy‖
  index iterations = 0;                           ///< of the solver
  index operator_applications = 0;                ///< of G, or of its parts
  index factorizations = 0;                       ///< matrices factored
};

template <class V>
using request_of = direction_request<scalar_t<V>>;
template <class V>
using report_of = direction_report<scalar_t<V>>;

template <class D, class G, class V>
concept has_prepare = requires(D const& d, G const& g, V const& f) {
  { d.prepare(g, f) } -> std::copyable;
};

/// What the solver keeps for operators G and vectors V.
template <class D, class G, class V>
using prepared_t =
    decltype(std::declval<D const&>().prepare(std::declval<G const&>(), std::declval<V const&>()));

template <class D, class G, class V>
concept has_direction = requires(D const& d, G const& g, V const& f, request_of<V> const& request,
                                 V& dy, prepared_t<D, G, V>& p) {
  { d.solve(g, f, request, dy, p) } -> std::same_as<report_of<V>>;
};

/// A linear solver for operators G and vectors V; see the top of this file.
template <class D, class G, class V>
concept direction_solver = has_prepare<D, G, V> && has_direction<D, G, V>;

namespace detail {

template <class D, class G, class V>
struct chosen_solver {
  using type = D;
};
template <class D, class G, class V>
  requires requires { typename D::template choice<G, V>; }
struct chosen_solver<D, G, V> {
  using type = typename D::template choice<G, V>;
};

}  // namespace detail

/// The solver that D stands for when it meets operators G: D itself, unless it leaves the choice to
/// the laws of G.
template <class D, class G, class V>
using chosen_solver_t = typename detail::chosen_solver<D, G, V>::type;

}  // namespace slant

namespace slant::detail {

/// Throws bad_input unless it is a number of iterations, or 0 for "choose".
inline void check_iteration_limit(index max_iterations) {
  if (max_iterations < 0) {
    throw bad_input("max_iterations", show(max_iterations), "a number >= 0");
  }
}

/// The limit given, or one that only a failure reaches: n iterations suffice without rounding.
template <class V>
[[nodiscard]] index iteration_limit(index max_iterations, V const& f) {
  return max_iterations > 0 ? max_iterations : 10 * slant::global_size(f) + 100;
}

/// A tolerance below the rounding error of a residual cannot be told from it.
template <class S>
[[nodiscard]] S attainable(S const& tolerance) {
  S const ε = detail::epsilon<S>();
  return tolerance > ε ? tolerance : ε;
}

/// Steps of an inner method until its residual is small enough, or it cannot or may not go on;
/// after_step(s) is called in between.
template <class Method, class State, class S, class AfterStep>
void run_until(Method const& method, State& s, S const& target, index limit, AfterStep after_step) {
  while (s.status == status::running && !(s.residual_norm <= target) && s.iteration < limit) {
    method.step(s);
    after_step(s);
  }
}

/// How the run ended, as the status of a linear solver.
template <class State, class S>
[[nodiscard]] status verdict_on(State const& s, S const& target) {
  if (s.residual_norm <= target) return status::converged;
  return s.status == status::running ? status::iteration_limit : s.status;
}

}  // namespace slant::detail
