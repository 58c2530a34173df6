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
//
// Laws.   report.residual_norm = ‖F + G dy‖ up to rounding;   converged ⇒ it is ≤ η ‖F‖.
//
// Why increments. [T Remark 3.1] starts the inner iteration for the new multipliers z⁺ from the old
// z. For the increment dz = z⁺ − z that is the start from zero, which is what solvers here do. What
// can still be carried over is the part of a shortened step that was not gone: `leftover`.
//
// Models. symmetrized_cg, cg_solver, bicgstab_solver, direct_solver, sparse_direct_solver, by_laws.
#pragma once

#include <slant/concepts/iterative_method.hpp>
#include <slant/concepts/linear_operator.hpp>

#include <concepts>
#include <type_traits>
#include <utility>

namespace slant {

/// What is asked of a linear solver.
template <class S>
struct direction_request {
  S tolerance{0};      ///< η in [0, 1); 0: as accurate as can be
  S residual_norm{0};  ///< ‖F‖, finite and > 0
  S leftover{0};       ///< in [0, 1): the part of the last direction that has not been gone
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

template <class D, class G, class V>
concept has_prepare = requires(D const& d, G const& g, V const& f) {
  { d.prepare(g, f) } -> std::copyable;
};

/// What the solver keeps for operators G and vectors V.
template <class D, class G, class V>
using prepared_t =
    decltype(std::declval<D const&>().prepare(std::declval<G const&>(), std::declval<V const&>()));

template <class D, class G, class V>
concept has_direction =
    requires(D const& d, G const& g, V const& f, direction_request<scalar_t<V>> const& request,
             V& dy, prepared_t<D, G, V>& p) {
      { d.solve(g, f, request, dy, p) } -> std::same_as<direction_report<scalar_t<V>>>;
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
