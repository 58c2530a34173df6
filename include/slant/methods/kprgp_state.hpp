// SPDX-License-Identifier: MIT
//
// The state of KPRGP, QPQ and QPC: everything that one step hands to the next, and all vectors it
// works in.
#pragma once

#include <slant/iteration/report.hpp>
#include <slant/krylov/conjugate_directions.hpp>
#include <slant/methods/gradient_point.hpp>
#include <slant/methods/progress_watch.hpp>
#include <slant/methods/recession.hpp>
#include <slant/sets/face.hpp>

#include <string>

namespace slant {

/// The three steps of KPRGP, QPQ and QPC.
enum class kprgp_step : unsigned char { conjugate_gradient, expansion, proportioning };

/// State of kprgp, qpq and qpc for a separable_qp of type QP.
template <class QP>
struct kprgp_state : gradient_point<QP> {
  using typename gradient_point<QP>::vector_type;
  using typename gradient_point<QP>::scalar;

  vector_type φ;                                 ///< free gradient; between steps scratch
  conjugate_directions<vector_type> directions;  ///< p, Ap, pᵀAp; p vanishes off the face
  recession_watch<vector_type> recession;        ///< looks for descent without end
  progress_watch<scalar> progress;               ///< looks for steps that get nowhere
  face_t<typename QP::set_type, local_t<vector_type>> face;  ///< that of x at the last restart

  scalar φr{0};  ///< φ̃ᵀr / unit², what the free set can still gain; of qpq and qpc: ‖φ‖² / unit²
  scalar βr{0};  ///< β̃ᵀr / unit², what the active set can still gain; of qpq and qpc: ‖β‖² / unit²
  scalar φr_at_restart{0};  ///< φr when the face was chosen
  scalar σ{0};              ///< σ_max to a few digits; known if A is not declared definite
  bool no_minimum = false;  ///< ended by a direction along which q has no minimum in floating point
  kprgp_step last_step = kprgp_step::conjugate_gradient;
  index iteration = 0;
  slant::status status = slant::status::running;

  kprgp_state(QP const& qp, vector_type const& x0)
      : gradient_point<QP>(qp, x0),
        φ(like(x0, qp.size())),
        directions(x0),
        recession(x0, declares_positive_definite<typename QP::operator_type> ? 0 : qp.size()) {}

  /// What a status other than running means here.
  [[nodiscard, gnu::cold]] std::string reason() const {
    switch (status) {
      case slant::status::converged:
        return "the reduced gradient vanishes";
      case slant::status::unbounded:
        return "the function decreases for ever along a direction of the set";
      case slant::status::stalled:
        return (no_minimum
                    ? "along a direction that does not leave the set the curvature is lost "
                      "in rounding errors: "
                    : "neither the reduced gradient nor the function has fallen any more: ") +
               this->accuracy();
      case slant::status::breakdown:
        return "a number left the range of the scalar, or A is not positive semidefinite";
      default:
        return std::string(to_string(status));
    }
  }
};

}  // namespace slant
