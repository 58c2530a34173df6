// SPDX-License-Identifier: MIT
//
// What the active set methods ask of their problem, and the answer to a problem that lacks
// something.
#pragma once

#include <slant/concepts/convex_set.hpp>
#include <slant/concepts/linear_operator.hpp>
#include <slant/iteration/detail/refused.hpp>
#include <slant/methods/detail/block_states.hpp>
#include <slant/methods/kprgp_state.hpp>

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

namespace detail {

template <class QP, class Rule>
using refused_proportioning = refused_method<typename QP::vector_type, kprgp_state<QP>,
                                             typename Rule::template options<typename QP::scalar>>;

}  // namespace detail

/// A problem that lacks something ends here; see methods/detail/active_set_complaint.hpp. The
/// method itself is in proportioning.hpp.
template <class QP, class Rule>
class proportioning : public detail::refused_proportioning<std::remove_cvref_t<QP>, Rule> {
 public:
  using proportioning::refused_method::refused_method;
};

/// No problem at all.
template <class QP, class Rule>
  requires(!quadratic_program<std::remove_cvref_t<QP>> &&
           !detail::was_refused<std::remove_cvref_t<QP>>)
class proportioning<QP, Rule> : public detail::refused_method<void, void> {
 public:
  using proportioning::refused_method::refused_method;
};

}  // namespace slant
