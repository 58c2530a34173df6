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

// --- active set complaint ------------------------------------------------------------------------
//
// The answer to a problem on which kprgp and its relatives cannot work. Each of them asks whether
// it was made. It is not said by their common base classes: one in which a static_assert fails is
// no base class any more for clang, which then complains of that as well.

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
