// SPDX-License-Identifier: MIT
//
// What MSSN, IMSSN and GIMSSN ask of their problem, and the answer to one that lacks something.
#pragma once

#include <slant/methods/kprgp_problem.hpp>
#include <slant/methods/modified_newton_options.hpp>
#include <slant/methods/modified_newton_state.hpp>

#include <type_traits>

namespace slant {

namespace detail {

template <class QP, class Inner, class Forcing>
using refused_modified_newton =
    refused_method<typename QP::vector_type, modified_newton_state<QP, Inner>,
                   modified_newton_options<typename QP::scalar, Forcing>>;

}  // namespace detail

/// A problem that lacks something ends here and is told so; see iteration/detail/refused.hpp. The
/// method itself is in modified_newton.hpp.
template <class QP, class Start, class Inner, class Forcing>
class modified_newton
    : public detail::refused_modified_newton<std::remove_cvref_t<QP>, Inner, Forcing> {
  using problem = std::remove_cvref_t<QP>;
  using a = detail::questions_about<typename problem::operator_type, typename problem::vector_type>;

  static_assert(linear_operator<typename a::whole, typename a::vector_type>,
                "mssn, imssn, gimssn: A must be a linear operator on vectors like b");
  static_assert(detail::usable_part<typename a::part, typename a::vector_type>,
                "mssn, imssn, gimssn: a part of A cannot be used on vectors like b");
  static_assert(psd_operator<typename a::promise, typename a::vector_type>,
                "mssn, imssn, gimssn: A must declare that it is self-adjoint and positive "
                "semidefinite");
  static_assert(
      active_set_domain<typename problem::set_type, local_t<typename problem::vector_type>>,
      "mssn, imssn, gimssn: the set must be made of blocks with state(x) and "
      "step_to_boundary(x, d)");

 public:
  using modified_newton::refused_method::refused_method;
};

/// A problem that was told so already.
template <class QP, class Start, class Inner, class Forcing>
  requires detail::was_refused<std::remove_cvref_t<QP>>
class modified_newton<QP, Start, Inner, Forcing>
    : public detail::refused_modified_newton<std::remove_cvref_t<QP>, Inner, Forcing> {
 public:
  using modified_newton::refused_method::refused_method;
};

/// No problem at all.
template <class QP, class Start, class Inner, class Forcing>
  requires(!quadratic_program<std::remove_cvref_t<QP>> &&
           !detail::was_refused<std::remove_cvref_t<QP>>)
class modified_newton<QP, Start, Inner, Forcing> : public detail::refused_method<void, void> {
  static_assert(quadratic_program<std::remove_cvref_t<QP>>,
                "mssn, imssn, gimssn: expected a separable_qp");

 public:
  using modified_newton::refused_method::refused_method;
};

}  // namespace slant
