// SPDX-License-Identifier: MIT
//
// The state of the semismooth Newton method with equality constraints.
#pragma once

#include <slant/concepts/vector_algebra.hpp>
#include <slant/iteration/report.hpp>
#include <slant/methods/augmented_problem.hpp>
#include <slant/methods/curved_minimum.hpp>
#include <slant/methods/cut_face.hpp>
#include <slant/methods/detail/reason_with_equalities.hpp>
#include <slant/methods/gradient_point.hpp>
#include <slant/methods/newton_segment.hpp>
#include <slant/methods/progress_watch.hpp>
#include <slant/methods/separable_qp.hpp>
#include <slant/methods/smalse_state.hpp>
#include <slant/newton/forcing.hpp>

#include <optional>
#include <string>
#include <utility>

namespace slant {

namespace detail {

/// ½ xᵀP A P x − bᵀx with b = P (b − A x̄) − ν: its operator is owned, the rest is referenced.
template <class QP, class C>
using projected_qp =
    separable_qp<decltype(slant::projected_hessian(
                     std::declval<typename QP::operator_type const&>(), std::declval<C const&>())),
                 typename QP::vector_type const&, typename QP::set_type const&>;

}  // namespace detail

/// The steps of constrained_newton.
enum class constrained_newton_step : unsigned char { none, full, damped, fallback };

/// State of constrained_newton for a separable_qp of type QP, constraints C and the preconditioner
/// M. x ∈ Λ with the gradient r of q(x) + νᵀx, computed from x, and its reduced gradient are those
/// of gradient_point.
template <class QP, class C, class M>
struct constrained_newton_state : gradient_point<detail::projected_qp<QP, C>> {
  using base = gradient_point<detail::projected_qp<QP, C>>;
  using typename base::scalar;
  using typename base::vector_type;

  vector_type ν;            ///< Gᵀμ, a gradient
  vector_type projected_b;  ///< P (b − A x̄)
  vector_type b;            ///< P (b − A x̄) − ν
  vector_type offset;       ///< Q x − x̄

  newton_segment<vector_type> segment;   ///< y, z of Newton's iterate; x = P_Λ(z) after a step
  vector_type offset_y;                  ///< Q y − x̄
  vector_type target_offset;             ///< the same at the end of the full step
  cut_face<scalar> face;                 ///< the face at z, cut by ker G
  curved_minimum<vector_type, M> inner;  ///< the step on it
  vector_type lifted;                    ///< the part of the step that cures Q x − x̄
  vector_type gradient_at_end;           ///< scratch: gradients of the quadratic model
  vector_type dν;                        ///< step of ν, in units
  workspace_t<decltype(std::declval<C const&>().range_projector()), vector_type> q_workspace;
  forcing_history<scalar> forcing{};              ///< errors and inner tolerances so far
  progress_watch<scalar> progress{};              ///< looks for steps that get nowhere
  std::optional<smalse_state<QP, C>> fallback{};  ///< of SMALSE-M, once there was need for it
  bool fallback_at_work = false;
  scalar goal{0};            ///< what the fallback has to reach
  index fallback_count = 0;  ///< how often it had to take over

  scalar merit{0};  ///< √(‖F‖² + ‖Q y − x̄‖²)/α, in units of the gradient
  scalar feasibility_norm{0};     ///< ‖Q x − x̄‖, distance of x from the affine space
  scalar feasibility_scale{0};    ///< max(‖x̄‖, ‖x‖)
  scalar load{0};                 ///< ‖P (b − A x̄)‖
  scalar preconditioner_size{1};  ///< s = mean(diag M)
  bool at_projection = false;     ///< x = P_Λ(z)
  constrained_newton_step last_step = constrained_newton_step::none;
  scalar step_fraction{1};     ///< β of the last Newton step
  index inner_iterations = 0;  ///< of the last step
  index iteration = 0;         ///< Newton steps and outer steps of the fallback
  slant::status status = slant::status::running;
  bool infeasible = false;  ///< no point of Λ satisfies G x = e, which has been shown

  template <class Projected>
  constrained_newton_state(Projected const& problem, C const& c, M const& m, vector_type const& x0,
                           vector_type const& load_vector)
      : base(problem, x0),
        ν(like(x0, problem.size())),
        projected_b(load_vector),
        b(load_vector),
        offset(ν),
        segment(x0, problem.size()),
        offset_y(ν),
        target_offset(ν),
        face(problem.set(), c.unit_rows()),
        inner(x0, problem.size(), m),
        lifted(ν),
        gradient_at_end(ν),
        dν(ν),
        q_workspace(workspace(c.range_projector(), x0)) {
    vectors::set_zero(ν);
  }

  /// What a status other than running means here.
  [[nodiscard, gnu::cold]] std::string reason() const {
    return detail::reason_with_equalities(status, infeasible);
  }
};

}  // namespace slant
