// SPDX-License-Identifier: MIT
//
// What semismooth_newton asks of its parts, and the answer to parts that lack something; see
// iteration/detail/refused.hpp. The vectors are not known before start(x0), so that is where most
// of it is asked.
#pragma once

#include <slant/concepts/slanting_function.hpp>
#include <slant/iteration/detail/refused.hpp>
#include <slant/newton/direction.hpp>
#include <slant/newton/forcing.hpp>
#include <slant/newton/globalisation.hpp>
#include <slant/slanting/slanting_base.hpp>

namespace slant {

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

}  // namespace slant
