// SPDX-License-Identifier: MIT
//
// The state of SMALSE-M.
#pragma once

#include <slant/iteration/report.hpp>
#include <slant/methods/augmented_problem.hpp>
#include <slant/methods/detail/reason_with_equalities.hpp>
#include <slant/methods/kprgp_state.hpp>
#include <slant/methods/progress_watch.hpp>
#include <slant/methods/separable_qp.hpp>

#include <string>
#include <type_traits>
#include <utility>

namespace slant {

namespace detail {

/// The inner problem: its operator is owned, its linear term and set are referenced.
template <class QP, class C>
using augmented_qp = separable_qp<decltype(slant::augmented_hessian(
                                      std::declval<typename QP::operator_type const&>(),
                                      std::declval<C const&>(), typename QP::scalar(1))),
                                  typename QP::vector_type const&, typename QP::set_type const&>;

}  // namespace detail

/// State of smalse for a separable_qp of type QP and constraints C.
template <class QP, class C>
struct smalse_state {
  using vector_type = typename QP::vector_type;
  using scalar = typename QP::scalar;
  using inner_state = kprgp_state<detail::augmented_qp<QP, C>>;

  vector_type x;            ///< in Λ; close to the affine space
  vector_type ν;            ///< Gᵀμ, the multiplier of G x = e, a gradient
  vector_type projected_b;  ///< P (b − A x̄)
  vector_type b;            ///< linear term of the last inner problem
  vector_type offset;       ///< Q x − x̄
  inner_state inner;        ///< of the method for L(·, ν, ρ); its r, r̃ belong to b
  workspace_t<decltype(std::declval<C const&>().range_projector()), vector_type> q_workspace;

  scalar σ{1};           ///< σ_max(P A P), from above
  scalar ρ{1};           ///< penalty
  scalar M{1};           ///< inner problems are solved until ‖r̃‖ ≤ M ‖Q x − x̄‖
  scalar η{0};           ///< and ‖r̃‖ ≤ η
  scalar lagrangian{0};  ///< L(x, ν, ρ) of the last inner problem, in units of inner.unit
  scalar feasibility_norm{0};   ///< ‖Q x − x̄‖, distance of x from the affine space
  scalar feasibility_scale{0};  ///< max(‖x̄‖, ‖x‖)
  scalar reduced_gradient_norm{0};  ///< ‖r̃‖ of L(·, ν, 0) with the new ν: of A x − b + ν on ker G
  scalar gradient_scale{0};    ///< min(‖P (b − A x̄)‖, ρ feasibility_scale), see step
  scalar load{0};              ///< ‖P (b − A x̄)‖
  index inner_iterations = 0;  ///< of the last outer step
  index iteration = 0;         ///< outer steps: updates of ν
  slant::status status = slant::status::running;
  slant::work work{};

  progress_watch<scalar> progress{};  ///< looks for steps that get nowhere
  bool resumed = true;                ///< the inner method has been told of ν already
  bool comparable = false;            ///< L may be compared with that of the step before
  bool infeasible = false;            ///< no point of Λ satisfies G x = e, which has been shown

  /// What a status other than running means here.
  [[nodiscard, gnu::cold]] std::string reason() const {
    return detail::reason_with_equalities(status, infeasible);
  }
};

}  // namespace slant
