// SPDX-License-Identifier: MIT
//
// What SSNM asks of its problem and of its linear solver, and the answer to those that lack
// something.
#pragma once

#include <slant/iteration/detail/refused.hpp>
#include <slant/methods/kprgp_problem.hpp>
#include <slant/methods/newton_parts.hpp>
#include <slant/methods/ssnm_options.hpp>
#include <slant/newton/schur_bicgstab.hpp>
#include <slant/slanting/kkt_function.hpp>

#include <type_traits>

namespace slant {

/// F of [T (2.11)] for a quadratic program, of which it refers to A and the set.
template <quadratic_program QP>
using ssnm_function = kkt_function<typename QP::operator_type const&, typename QP::vector_type,
                                   typename QP::set_type const&>;

/// A quadratic program, and a linear solver for its F°.
template <class QP, class LinearSolver>
concept ssnm_parts =
    quadratic_program<QP> && !detail::was_refused<QP> &&
    direction_solver<LinearSolver, slant_operator_t<ssnm_function<QP>, typename QP::vector_type>,
                     typename QP::vector_type>;

/// Parts that lack something end here and are told so; see iteration/detail/refused.hpp. The method
/// itself is in ssnm.hpp.
template <class QP, class LinearSolver = schur_bicgstab>
class ssnm : public detail::refused_method<typename std::remove_cvref_t<QP>::vector_type> {
  using problem = std::remove_cvref_t<QP>;
  using V = typename problem::vector_type;

  static consteval bool told() {
    detail::refuse_solver<LinearSolver, slant_operator_t<ssnm_function<problem>, V>, V>();
    return true;
  }
  static_assert(told());

 public:
  using ssnm::refused_method::refused_method;
};

/// A problem that was told so already.
template <class QP, class LinearSolver>
  requires detail::was_refused<std::remove_cvref_t<QP>>
class ssnm<QP, LinearSolver>
    : public detail::refused_method<typename std::remove_cvref_t<QP>::vector_type> {
 public:
  using ssnm::refused_method::refused_method;
};

/// No problem at all.
template <class QP, class LinearSolver>
  requires(!quadratic_program<std::remove_cvref_t<QP>>)
class ssnm<QP, LinearSolver> : public detail::refused_method<void> {
  static_assert(quadratic_program<std::remove_cvref_t<QP>>, "ssnm: expected a separable_qp");

 public:
  using ssnm::refused_method::refused_method;
};

}  // namespace slant
