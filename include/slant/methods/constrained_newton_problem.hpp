// SPDX-License-Identifier: MIT
//
// What constrained_newton asks of its problem, and the answer to arguments that lack something.
#pragma once

#include <slant/iteration/detail/part_to_blame.hpp>
#include <slant/iteration/detail/refused.hpp>
#include <slant/methods/augmented_problem.hpp>
#include <slant/methods/constrained_newton_options.hpp>
#include <slant/methods/preconditioner_for.hpp>
#include <slant/methods/smalse_problem.hpp>
#include <slant/methods/symmetric_newton_problem.hpp>
#include <slant/operators/held.hpp>
#include <slant/operators/identity.hpp>

#include <type_traits>

namespace slant {

/// min ½ xᵀA x − bᵀx over x ∈ Λ, G x = e: a problem for symmetric_newton, and rows.
template <class QP, class C>
concept constrained_newton_problem =
    symmetric_newton_problem<QP> && affine_space_with_rows<C, typename QP::vector_type>;

/// Arguments that lack something end here and are told so; see iteration/detail/refused.hpp. The
/// method itself is in constrained_newton.hpp.
template <class QP, class C, class M>
class constrained_newton
    : public detail::refused_method<typename std::remove_cvref_t<QP>::vector_type> {
  using problem = std::remove_cvref_t<QP>;
  using vector_type = typename problem::vector_type;
  static constexpr bool good_problem = symmetric_newton_problem<problem>;

  static_assert(good_problem,
                "constrained_newton: the problem must be one that symmetric_newton takes");
  static_assert(!good_problem || affine_space_with_rows<std::remove_cvref_t<C>, vector_type>,
                "constrained_newton: the constraints must be equality_constraints of vectors like "
                "b, which must be an Eigen vector");
  static_assert(psd_operator<std::remove_cvref_t<M>, vector_type>,
                "constrained_newton: the preconditioner must be a linear operator on vectors like "
                "b that declares self_adjoint and positive_semidefinite");

 public:
  using constrained_newton::refused_method::refused_method;
};

template <class QP, class C>
constrained_newton(QP&&, C&&) -> constrained_newton<kept_t<QP>, kept_t<C>, identity_operator>;
template <class QP, class C>
constrained_newton(QP&&, C&&, constrained_newton_options<typename std::remove_cvref_t<QP>::scalar>)
    -> constrained_newton<kept_t<QP>, kept_t<C>, identity_operator>;
template <class QP, class C, class M>
constrained_newton(QP&&, C&&, M&&) -> constrained_newton<kept_t<QP>, kept_t<C>, kept_t<M>>;
template <class QP, class C, class M>
constrained_newton(QP&&, C&&, M&&,
                   constrained_newton_options<typename std::remove_cvref_t<QP>::scalar>)
    -> constrained_newton<kept_t<QP>, kept_t<C>, kept_t<M>>;

}  // namespace slant
