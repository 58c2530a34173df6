// SPDX-License-Identifier: MIT
//
// What the interior-point method asks of its problem, and the answer to a problem that lacks
// something.
#pragma once

#include <slant/iteration/detail/part_to_blame.hpp>
#include <slant/iteration/detail/refused.hpp>
#include <slant/methods/compiled_problem.hpp>
#include <slant/methods/detail/block_inequalities.hpp>
#include <slant/methods/interior_point_options.hpp>
#include <slant/methods/interior_point_state.hpp>
#include <slant/methods/kprgp_problem.hpp>
#include <slant/methods/preconditioner_for.hpp>
#include <slant/operators/held.hpp>
#include <slant/operators/identity.hpp>

#include <type_traits>

namespace slant {

/// A product of blocks with smooth inequalities in which a step to the boundary is known.
template <class C, class V>
concept interior_point_domain =
    convex_set<C, V> && has_block_inequalities<C, V> && has_step_to_boundary<C, V>;

/// What interior_point works on: min ½ xᵀA x − bᵀx over x ∈ Λ, A symmetric positive semidefinite.
template <class QP>
concept interior_point_problem =
    quadratic_program<QP> && psd_operator<typename QP::operator_type, typename QP::vector_type> &&
    interior_point_domain<typename QP::set_type, local_t<typename QP::vector_type>>;

namespace detail {

template <class QP>
using refused_interior_point =
    refused_method<typename QP::vector_type, interior_point_state<QP, identity_operator>,
                   interior_point_options<typename QP::scalar>>;

}  // namespace detail

/// A problem that lacks something ends here and is told so; see iteration/detail/refused.hpp. The
/// method itself is in interior_point.hpp.
template <class QP, class M = identity_operator>
class interior_point : public detail::refused_interior_point<std::remove_cvref_t<QP>> {
  using problem = std::remove_cvref_t<QP>;
  using vector_type = typename problem::vector_type;
  using a = detail::questions_about<typename problem::operator_type, vector_type>;
  using m = detail::questions_about<std::remove_cvref_t<M>, vector_type>;
  using set_type = typename problem::set_type;
  using points = local_t<vector_type>;
  static constexpr bool smooth = has_block_inequalities<set_type, points>;

  static_assert(linear_operator<typename a::whole, typename a::vector_type>,
                "interior_point: A must be a linear operator on vectors like b");
  static_assert(detail::usable_part<typename a::part, typename a::vector_type>,
                "interior_point: a part of A cannot be used on vectors like b");
  static_assert(psd_operator<typename a::promise, typename a::vector_type>,
                "interior_point: A must declare that it is self-adjoint and positive semidefinite");
  static_assert(smooth,
                "interior_point: the set must be made of blocks with a smooth inequality form and "
                "step_to_boundary(x, d)");
  static_assert(!smooth || has_step_to_boundary<set_type, points>,
                "interior_point: the set must have step_to_boundary(x, d)");
  static_assert(linear_operator<typename m::whole, typename m::vector_type>,
                "interior_point: the preconditioner must be a linear operator on vectors like b");
  static_assert(detail::usable_part<typename m::part, typename m::vector_type>,
                "interior_point: a part of the preconditioner cannot be used on vectors like b");
  static_assert(psd_operator<typename m::promise, typename m::vector_type>,
                "interior_point: the preconditioner must declare self_adjoint and "
                "positive_semidefinite");

 public:
  using interior_point::refused_method::refused_method;
};

/// A problem that was told so already.
template <class QP, class M>
  requires detail::was_refused<std::remove_cvref_t<QP>>
class interior_point<QP, M> : public detail::refused_interior_point<std::remove_cvref_t<QP>> {
 public:
  using interior_point::refused_method::refused_method;
};

/// No problem at all.
template <class QP, class M>
  requires(!quadratic_program<std::remove_cvref_t<QP>> &&
           !detail::was_refused<std::remove_cvref_t<QP>>)
class interior_point<QP, M> : public detail::refused_method<void, void> {
  static_assert(quadratic_program<std::remove_cvref_t<QP>>,
                "interior_point: expected a separable_qp");

 public:
  using interior_point::refused_method::refused_method;
};

template <class QP>
interior_point(QP&&) -> interior_point<compiled_problem_t<QP>, identity_operator>;
template <class QP>
interior_point(QP&&, interior_point_options<typename std::remove_cvref_t<QP>::scalar>)
    -> interior_point<compiled_problem_t<QP>, identity_operator>;
template <class QP, class M>
interior_point(QP&&, M&&)
    -> interior_point<compiled_problem_t<QP>, compiled_preconditioner_t<QP, M>>;
template <class QP, class M>
interior_point(QP&&, M&&, interior_point_options<typename std::remove_cvref_t<QP>::scalar>)
    -> interior_point<compiled_problem_t<QP>, compiled_preconditioner_t<QP, M>>;

}  // namespace slant
