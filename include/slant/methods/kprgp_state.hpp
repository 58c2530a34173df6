// SPDX-License-Identifier: MIT
//
// The state of KPRGP: everything that one step hands to the next, and all vectors it works in.
#pragma once

#include <slant/iteration/report.hpp>
#include <slant/krylov/conjugate_directions.hpp>
#include <slant/methods/recession.hpp>
#include <slant/sets/face.hpp>

namespace slant {

/// The three steps of KPRGP.
enum class kprgp_step : unsigned char { conjugate_gradient, expansion, proportioning };

/// State of kprgp for a separable_qp of type QP.
template <class QP>
struct kprgp_state {
  using vector_type = typename QP::vector_type;
  using scalar = typename QP::scalar;

  vector_type x;                                 ///< iterate, in Λ
  vector_type r;                                 ///< gradient A x − b, in multiples of unit
  vector_type projected;                         ///< P_Λ(x − α̃ r)
  vector_type reduced;                           ///< reduced gradient r̃, in multiples of unit
  vector_type φ;                                 ///< free gradient; between steps scratch
  vector_type trial;                             ///< scratch
  slant::face<scalar> face;                      ///< blocks that could move at the last restart
  conjugate_directions<vector_type> directions;  ///< p, Ap, pᵀAp; p vanishes off the face
  recession_watch<vector_type> recession;        ///< looks for descent without end
  workspace_t<typename QP::operator_type, vector_type> a_workspace;  ///< temporaries of A

  scalar unit{1};                   ///< of r and r̃, a power of two; see krylov/unit.hpp
  scalar step_length{0};            ///< α̃ of the gradient steps
  scalar φr{0};                     ///< φ̃ᵀr / unit², what the free set can still gain
  scalar βr{0};                     ///< β̃ᵀr / unit², what the active set can still gain
  scalar reduced_gradient_norm{0};  ///< ‖r̃‖
  scalar gradient_scale{0};         ///< max(‖b‖, ‖A x‖): what ‖r̃‖ is small against
  scalar scale_of_b{0};             ///< ‖b‖, or ‖A x₀‖ if b = 0
  scalar best_norm{0};              ///< smallest ‖r̃‖ so far
  index best_iteration = 0;         ///< and when it was reached
  index since_refresh = 0;          ///< CG steps since r was computed from x
  kprgp_step last_step = kprgp_step::conjugate_gradient;
  index iteration = 0;
  slant::status status = slant::status::running;
  slant::work work{};

  kprgp_state(QP const& qp, vector_type const& x0)
      : x(x0),
        r(like(x0, qp.size())),
        projected(like(x0, qp.size())),
        reduced(like(x0, qp.size())),
        φ(like(x0, qp.size())),
        trial(like(x0, qp.size())),
        directions(x0),
        recession(x0, declares_positive_definite<typename QP::operator_type> ? 0 : qp.size()),
        a_workspace(workspace(qp.a(), x0)) {}
};

}  // namespace slant
