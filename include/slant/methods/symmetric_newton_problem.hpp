// SPDX-License-Identifier: MIT
//
// What the symmetric semismooth Newton method asks of its problem, and the answer to a problem that
// lacks something.
#pragma once

#include <slant/iteration/detail/part_to_blame.hpp>
#include <slant/iteration/detail/refused.hpp>
#include <slant/methods/compiled_problem.hpp>
#include <slant/methods/detail/block_slants.hpp>
#include <slant/methods/kprgp_problem.hpp>
#include <slant/methods/preconditioner_for.hpp>
#include <slant/methods/symmetric_newton_options.hpp>
#include <slant/methods/symmetric_newton_state.hpp>
#include <slant/operators/held.hpp>
#include <slant/operators/identity.hpp>

#include <type_traits>

namespace slant {

/// min ½ xᵀA x − bᵀx over x ∈ Λ as kprgp takes it, Λ of blocks whose projections have slant(x).
template <class QP>
concept symmetric_newton_problem =
    kprgp_problem<QP> && has_block_slants<typename QP::set_type, local_t<typename QP::vector_type>>;

namespace detail {

template <class QP>
using refused_symmetric_newton =
    refused_method<typename QP::vector_type, symmetric_newton_state<QP, identity_operator>,
                   symmetric_newton_options<typename QP::scalar>>;

}  // namespace detail

/// A problem that lacks something ends here and is told so; see iteration/detail/refused.hpp. The
/// method itself is in symmetric_newton.hpp.
template <class QP, class M = identity_operator>
class symmetric_newton : public detail::refused_symmetric_newton<std::remove_cvref_t<QP>> {
  using problem = std::remove_cvref_t<QP>;
  using vector_type = typename problem::vector_type;
  using a = detail::questions_about<typename problem::operator_type, vector_type>;
  using m = detail::questions_about<std::remove_cvref_t<M>, vector_type>;
  using set_type = typename problem::set_type;
  using points = local_t<vector_type>;
  static constexpr bool good_domain = active_set_domain<set_type, points>;

  static_assert(linear_operator<typename a::whole, typename a::vector_type>,
                "symmetric_newton: A must be a linear operator on vectors like b");
  static_assert(detail::usable_part<typename a::part, typename a::vector_type>,
                "symmetric_newton: a part of A cannot be used on vectors like b");
  static_assert(
      psd_operator<typename a::promise, typename a::vector_type>,
      "symmetric_newton: A must declare that it is self-adjoint and positive semidefinite");
  static_assert(good_domain,
                "symmetric_newton: the set must be made of blocks with state(x) and "
                "step_to_boundary(x, d)");
  static_assert(!good_domain || has_block_slants<set_type, points>,
                "symmetric_newton: the set must be made of blocks with slant(x)");
  static_assert(linear_operator<typename m::whole, typename m::vector_type>,
                "symmetric_newton: the preconditioner must be a linear operator on vectors like b");
  static_assert(detail::usable_part<typename m::part, typename m::vector_type>,
                "symmetric_newton: a part of the preconditioner cannot be used on vectors like b");
  static_assert(psd_operator<typename m::promise, typename m::vector_type>,
                "symmetric_newton: the preconditioner must declare self_adjoint and "
                "positive_semidefinite");

 public:
  using symmetric_newton::refused_method::refused_method;
};

/// A problem that was told so already.
template <class QP, class M>
  requires detail::was_refused<std::remove_cvref_t<QP>>
class symmetric_newton<QP, M> : public detail::refused_symmetric_newton<std::remove_cvref_t<QP>> {
 public:
  using symmetric_newton::refused_method::refused_method;
};

/// No problem at all.
template <class QP, class M>
  requires(!quadratic_program<std::remove_cvref_t<QP>> &&
           !detail::was_refused<std::remove_cvref_t<QP>>)
class symmetric_newton<QP, M> : public detail::refused_method<void, void> {
  static_assert(quadratic_program<std::remove_cvref_t<QP>>,
                "symmetric_newton: expected a separable_qp");

 public:
  using symmetric_newton::refused_method::refused_method;
};

template <class QP>
symmetric_newton(QP&&) -> symmetric_newton<compiled_problem_t<QP>, identity_operator>;
template <class QP>
symmetric_newton(QP&&, symmetric_newton_options<typename std::remove_cvref_t<QP>::scalar>)
    -> symmetric_newton<compiled_problem_t<QP>, identity_operator>;
template <class QP, class M>
symmetric_newton(QP&&, M&&)
    -> symmetric_newton<compiled_problem_t<QP>, compiled_preconditioner_t<QP, M>>;
template <class QP, class M>
symmetric_newton(QP&&, M&&, symmetric_newton_options<typename std::remove_cvref_t<QP>::scalar>)
    -> symmetric_newton<compiled_problem_t<QP>, compiled_preconditioner_t<QP, M>>;

}  // namespace slant
