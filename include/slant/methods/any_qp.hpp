// SPDX-License-Identifier: MIT
//
// A quadratic program whose operator and set are forgotten by its type: what is written for it is
// compiled once, whatever A and Λ are.
//
//     slant::separable_qp const given{A, b, Λ};
//     auto const qp = slant::erased(given);
//     auto const run = slant::solve(slant::kprgp{qp}, x0, stop);
//
// An application of A costs three virtual calls more, a visit of all blocks one question for each
// run of blocks of one kind. Steps, counts and bits are the same, except where a method asks A for
// more than its action: diagonal and inverse are forgotten too.
#pragma once

#include <slant/methods/separable_qp.hpp>
#include <slant/operators/any_operator.hpp>
#include <slant/sets/any_set.hpp>

namespace slant {

/// minimise ½ xᵀA x − bᵀx over x ∈ Λ with A of the laws L, Λ of the usual blocks.
template <scalar S = double,
          law_set L = slant::laws<slant::self_adjoint, slant::positive_semidefinite>>
using any_qp = separable_qp<any_operator<Eigen::Matrix<S, Eigen::Dynamic, 1>, L>,
                            Eigen::Matrix<S, Eigen::Dynamic, 1>, any_set<S>>;

/// The same program with its types forgotten, as definite as A declares to be. Refers to the
/// operator of qp, copies b and the set.
template <class QP>
  requires has_usual_blocks<typename QP::set_type, typename QP::scalar>
[[nodiscard]] auto erased(QP const& qp) {
  using S = typename QP::scalar;
  using vector_type = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  constexpr law_set L = declares_positive_definite<typename QP::operator_type>
                            ? slant::laws<slant::self_adjoint, slant::positive_definite>
                            : slant::laws<slant::self_adjoint, slant::positive_semidefinite>;
  return any_qp<S, L>{held<any_operator<vector_type, L>>(any_operator<vector_type, L>(qp.a())),
                      held<vector_type>(vector_type(qp.b())),
                      held<any_set<S>>(any_set<S>(qp.set()))};
}
template <class QP>
void erased(QP const&&) = delete;

}  // namespace slant
