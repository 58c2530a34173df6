// SPDX-License-Identifier: MIT
//
// What the active set methods ask of their problem, and the answer to a problem that lacks
// something.
#pragma once

#include <slant/base/diagnosis.hpp>
#include <slant/concepts/convex_set.hpp>
#include <slant/concepts/linear_operator.hpp>
#include <slant/sets/block_queries.hpp>

#include <concepts>
#include <type_traits>

namespace slant {

template <class QP>
concept has_hessian = requires(QP const& qp) {
  { qp.a() } -> std::same_as<typename QP::operator_type const&>;
};
template <class QP>
concept has_linear_term = requires(QP const& qp) {
  { qp.b() } -> std::same_as<typename QP::vector_type const&>;
};
template <class QP>
concept has_feasible_set = requires(QP const& qp) {
  { qp.set() } -> std::same_as<typename QP::set_type const&>;
};
/// A quadratic program: A, b and a set of vectors with size() entries, as separable_qp has them.
template <class QP>
concept quadratic_program =
    has_hessian<QP> && has_linear_term<QP> && has_feasible_set<QP> && has_size<QP>;

template <class QP>
concept has_separable_function = requires(QP const& qp) {
  { qp.function() } -> std::same_as<typename QP::set_type const&>;
};
/// A quadratic function plus a separable convex one, which may be the indicator of a set.
template <class QP>
concept composite_problem = quadratic_program<QP> || (has_hessian<QP> && has_linear_term<QP> &&
                                                      has_separable_function<QP> && has_size<QP>);

/// φ of a composite problem; of a quadratic program the set that it is the indicator of.
template <composite_problem QP>
[[nodiscard]] auto const& function_of(QP const& qp) {
  if constexpr (quadratic_program<QP>) {
    return qp.set();
  } else {
    return qp.function();
  }
}

/// A convex set whose faces and boundary a method can follow.
template <class C, class V>
concept active_set_domain =
    separable_set<C, V> && has_block_states<C, V> && has_step_to_boundary<C, V>;

/// What kprgp and its relatives work on: min ½ xᵀA x − bᵀx over x ∈ Λ, A symmetric positive
/// semidefinite.
template <class QP>
concept kprgp_problem =
    quadratic_program<QP> && psd_operator<typename QP::operator_type, typename QP::vector_type> &&
    active_set_domain<typename QP::set_type, local_t<typename QP::vector_type>>;

}  // namespace slant

namespace slant::detail {

// --- demands -------------------------------------------------------------------------------------
//
// What is said of the program that a method is given. Not by a common base class of the methods: one in
// which a static_assert fails is no base class any more for clang, which then complains of that as well.

/// A program of which nothing has been said yet.
template <class QP> concept askable_program = quadratic_program<QP> && !was_refused<QP>;

/// Of any problem: A is semidefinite on vectors like b.
template <class QP>
struct composite_demands {
  static_assert(quadratic_program<QP>, "expected a separable_qp");
  static constexpr bool told = true;
};
template <was_refused QP>
struct composite_demands<QP> {
  static constexpr bool told = true;
};
template <composite_problem QP>
  requires(!was_refused<QP>)
struct composite_demands<QP> {
  static constexpr bool told =
      operator_demands<typename QP::operator_type, typename QP::vector_type,
                       law_demand::semidefinite>::told;
};

/// Where φ has to be a set as well.
template <class QP>
struct program_demands {
  static_assert(quadratic_program<QP> || was_refused<QP> || !composite_problem<QP>,
                "expected a separable_qp with a convex set, not with another function");
  static constexpr bool told = composite_demands<QP>::told;
};

/// And of that set, where a method follows faces.
template <class QP>
struct active_set_demands {
  static constexpr bool told = true;
};
template <askable_program QP>
struct active_set_demands<QP> {
  static_assert(active_set_domain<typename QP::set_type, local_t<typename QP::vector_type>>,
                "the set must be made of blocks with state(x) and step_to_boundary(x, d)");
  static constexpr bool told = true;
};

/// The scalar of a program, double of what is none: deduction does not fail there, so that it can
/// be refused in words.
template <class QP>
using program_scalar_t = set_scalar_t<QP>;

/// The vectors of a program of which nothing has been said yet.
template <class QP>
struct vector_of {
  using type = stand_in;
};
template <askable_program QP>
struct vector_of<QP> {
  using type = typename QP::vector_type;
};

/// A method that refuses the program QP, with the state and the options that it would have had.
template <class QP, class State, class Options>
struct refusal {
  using type = refused_method<void, void>;
};
template <class QP, class State, class Options>
  requires composite_problem<QP> || was_refused<QP>
struct refusal<QP, State, Options> {
  using vectors = typename QP::vector_type;
  using state = std::conditional_t<std::is_void_v<State>, refused_state<vectors>, State>;
  using type = refused_method<vectors, state, Options>;
};
template <class QP, class State = void, class Options = no_options>
using refused_program = typename refusal<std::remove_cvref_t<QP>, State, Options>::type;

}  // namespace slant::detail
