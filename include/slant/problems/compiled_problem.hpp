// SPDX-License-Identifier: MIT
//
// Which type a method is instantiated for. slant::compiled has the usual methods for
// any_qp<double>; in a program that links it,
//
//     slant::symmetric_newton{qp}     is a     symmetric_newton<any_qp<double, …>>
//
// for every program on Eigen::VectorXd with a semidefinite A and blocks of the usual kinds, and is
// not instantiated anew. (Unless A has a twin of lower precision, which any_operator forgets.) A
// preconditioner is forgotten with the problem, unless it has a form of its own on faces. Making
// such a method allocates a few small objects; its steps allocate nothing more. Without the
// component, or for other problems, it is an instance of its own. Steps, counts and bits are the
// same (tests/compiled), and problems are referenced and owned by the same rule. A type that is
// spelt out, symmetric_newton<QP const&>, is what it says.
#pragma once

#include <slant/base/held.hpp>
#include <slant/compiled.hpp>
#include <slant/concepts/capabilities.hpp>

#if SLANT_USES_COMPILED
#include <slant/krylov/preconditioner.hpp>
#include <slant/operators/any_operator.hpp>
#include <slant/operators/identity.hpp>
#include <slant/problems/any_qp.hpp>
#include <slant/sets/curved_face.hpp>
#endif

#include <concepts>
#include <type_traits>

namespace slant {

namespace detail {

template <class QP>
struct compiled_problem {
  using type = kept_t<QP>;
};

#if SLANT_USES_COMPILED
template <class QP>
concept is_compiled_problem =
    forgettable_problem<QP, usual_runs<double>> && std::same_as<typename QP::scalar, double> &&
    laws_of<typename QP::operator_type>.contains(semidefinite_laws) &&
    !has_rounded<typename QP::operator_type, typename QP::vector_type>;

template <class QP>
  requires is_compiled_problem<std::remove_cvref_t<QP>>
struct compiled_problem<QP> {
  using type = erased_t<std::remove_cvref_t<QP>, usual_runs<double>>;
};
#endif

template <class QP, class M>
struct compiled_preconditioner {
  using type = kept_t<M>;
};

#if SLANT_USES_COMPILED
template <class QP, class M>
  requires is_compiled_problem<std::remove_cvref_t<QP>> &&
           psd_operator<std::remove_cvref_t<M>, Eigen::VectorXd> &&
           (!has_rounded<std::remove_cvref_t<M>, Eigen::VectorXd>) &&
           (!preconditions_faces<std::remove_cvref_t<M>, Eigen::VectorXd, curved_face<double>>) &&
           (!std::same_as<std::remove_cvref_t<M>, identity_operator>)
struct compiled_preconditioner<QP, M> {
  using type = any_operator<Eigen::VectorXd, semidefinite_laws>;
};
#endif

}  // namespace detail

/// How a method keeps a problem that it is made of, a parameter of the deduced type QP&&.
template <class QP>
using compiled_problem_t = typename detail::compiled_problem<QP>::type;
/// How it keeps a preconditioner M&& beside it.
template <class QP, class M>
using compiled_preconditioner_t = typename detail::compiled_preconditioner<QP, M>::type;

}  // namespace slant
