// SPDX-License-Identifier: MIT
//
// The answer to a problem on which kprgp and its relatives cannot work. Each of them asks whether
// it was made. It is not said by their common base classes: one in which a static_assert fails is
// no base class any more for clang, which then complains of that as well.
#pragma once

#include <slant/iteration/detail/part_to_blame.hpp>
#include <slant/iteration/detail/refused.hpp>
#include <slant/methods/kprgp_problem.hpp>

namespace slant::detail {

/// Says what a problem lacks.
template <class QP>
struct active_set_complaint {
  static constexpr bool made = true;
  using a = questions_about<typename QP::operator_type, typename QP::vector_type>;

  static_assert(
      linear_operator<typename a::whole, typename a::vector_type>,
      "gimssn, imssn, mssn, qpc, qpq, kprgp: A must be a linear operator on vectors like b");
  static_assert(
      usable_part<typename a::part, typename a::vector_type>,
      "gimssn, imssn, mssn, qpc, qpq, kprgp: a part of A cannot be used on vectors like b");
  static_assert(psd_operator<typename a::promise, typename a::vector_type>,
                "gimssn, imssn, mssn, qpc, qpq, kprgp: A must declare that it is self-adjoint and "
                "positive semidefinite");
  static_assert(active_set_domain<typename QP::set_type, local_t<typename QP::vector_type>>,
                "gimssn, imssn, mssn, qpc, qpq, kprgp: the set must be made of blocks with "
                "state(x) and step_to_boundary(x, d)");
};

/// A problem that was told so already.
template <class QP>
  requires was_refused<QP>
struct active_set_complaint<QP> {
  static constexpr bool made = true;
};

/// No problem at all.
template <class QP>
  requires(!quadratic_program<QP> && !was_refused<QP>)
struct active_set_complaint<QP> {
  static constexpr bool made = true;
  static_assert(quadratic_program<QP>,
                "gimssn, imssn, mssn, qpc, qpq, kprgp: expected a separable_qp");
};

}  // namespace slant::detail
