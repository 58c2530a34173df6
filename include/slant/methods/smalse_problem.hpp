// SPDX-License-Identifier: MIT
//
// What smalse asks of its problem, and the answer to arguments that lack something.
#pragma once

#include <slant/iteration/detail/part_to_blame.hpp>
#include <slant/iteration/detail/refused.hpp>
#include <slant/methods/augmented_problem.hpp>
#include <slant/methods/kprgp_problem.hpp>
#include <slant/methods/smalse_options.hpp>
#include <slant/operators/held.hpp>

#include <type_traits>

namespace slant {

/// min ½ xᵀA x − bᵀx over x ∈ Λ, G x = e: a problem for kprgp, and an affine space.
template <class QP, class C>
concept smalse_problem = kprgp_problem<QP> && affine_space<C, typename QP::vector_type>;

/// Arguments that lack something end here and are told so; see iteration/detail/refused.hpp. The
/// method itself is in smalse.hpp.
template <class QP, class C>
class smalse : public detail::refused_method<typename std::remove_cvref_t<QP>::vector_type> {
  using problem = std::remove_cvref_t<QP>;
  using vector_type = typename problem::vector_type;
  using a = detail::questions_about<typename problem::operator_type, vector_type>;
  static constexpr bool good_problem = kprgp_problem<problem>;

  static_assert(linear_operator<typename a::whole, typename a::vector_type>,
                "smalse: A must be a linear operator on vectors like b");
  static_assert(detail::usable_part<typename a::part, typename a::vector_type>,
                "smalse: a part of A cannot be used on vectors like b");
  static_assert(psd_operator<typename a::promise, typename a::vector_type>,
                "smalse: A must declare that it is self-adjoint and positive semidefinite");
  static_assert(active_set_domain<typename problem::set_type, local_t<vector_type>>,
                "smalse: the set must be made of blocks with state(x) and step_to_boundary(x, d)");
  static_assert(!good_problem || affine_space<std::remove_cvref_t<C>, vector_type>,
                "smalse: the constraints must be equality_constraints of vectors like b");

 public:
  using smalse::refused_method::refused_method;
};

/// A problem that was told so already.
template <class QP, class C>
  requires detail::was_refused<std::remove_cvref_t<QP>>
class smalse<QP, C> : public detail::refused_method<typename std::remove_cvref_t<QP>::vector_type> {
 public:
  using smalse::refused_method::refused_method;
};

/// No problem at all.
template <class QP, class C>
  requires(!quadratic_program<std::remove_cvref_t<QP>> &&
           !detail::was_refused<std::remove_cvref_t<QP>>)
class smalse<QP, C> : public detail::refused_method<void, void> {
  static_assert(quadratic_program<std::remove_cvref_t<QP>>, "smalse: expected a separable_qp");

 public:
  using smalse::refused_method::refused_method;
};

template <class QP, class C>
smalse(QP&&, C&&) -> smalse<kept_t<QP>, kept_t<C>>;
template <class QP, class C>
smalse(QP&&, C&&, smalse_options<typename std::remove_cvref_t<QP>::scalar>)
    -> smalse<kept_t<QP>, kept_t<C>>;

}  // namespace slant
