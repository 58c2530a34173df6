// SPDX-License-Identifier: MIT
//
// The state of MSSN, IMSSN and GIMSSN: everything that one step hands to the next, and all vectors
// it works in.
#pragma once

#include <slant/iteration/report.hpp>
#include <slant/krylov/conjugate_directions.hpp>
#include <slant/methods/gradient_point.hpp>
#include <slant/methods/modified_newton_parts.hpp>
#include <slant/methods/progress_watch.hpp>
#include <slant/methods/recession.hpp>
#include <slant/sets/face.hpp>

#include <string>

namespace slant {

/// An iterate λ that has left Λ: the state's x is then P_Λ(λ).
template <class V>
struct outside_point {
  V x;                      ///< λ
  V r;                      ///< its gradient, in multiples of the state's unit
  index since_refresh = 0;  ///< steps since r was computed from λ
  bool in_use = false;      ///< false: λ is the state's x

  explicit outside_point(V const& prototype)
      : x(like(prototype, slant::local(prototype).size())),
        r(like(prototype, slant::local(prototype).size())) {}
};

/// Methods that stay in Λ need none.
struct never_outside {
  template <class V>
  explicit never_outside(V const&) {}
};

/// State of mssn, imssn and gimssn for a separable_qp of type QP and the inner iterations Inner.
template <class QP, class Inner>
struct modified_newton_state : gradient_point<QP> {
  using typename gradient_point<QP>::vector_type;
  using typename gradient_point<QP>::scalar;
  using outside_type =
      std::conditional_t<Inner::stays_inside, never_outside, outside_point<vector_type>>;

  vector_type φ;                                 ///< r on the face; between steps scratch
  conjugate_directions<vector_type> directions;  ///< p, Ap, pᵀAp; p vanishes off the face
  outside_type outside;                          ///< λ, where it is not x
  recession_watch<vector_type> recession;        ///< looks for descent without end
  progress_watch<scalar> progress;               ///< looks for steps that get nowhere
  face_t<typename QP::set_type, local_t<vector_type>> face;  ///< of the last step; free blocks: 𝒜

  forcing_history<scalar> forcing{};  ///< err^(k), err^(0), and the last tolerance η
  scalar σ{0};                        ///< σ_max to a few digits; known if ρ was not given
  index inner_iterations = 0;         ///< of the last step; those of all steps are in work
  inner_end last_inner = inner_end::going_on;  ///< how they ended
  index iteration = 0;
  slant::status status = slant::status::running;

  modified_newton_state(QP const& qp, vector_type const& x0)
      : gradient_point<QP>(qp, x0),
        φ(like(x0, qp.size())),
        directions(x0),
        outside(x0),
        recession(x0, declares_positive_definite<typename QP::operator_type> ? 0 : qp.size()) {}

  /// What a status other than running means here.
  [[nodiscard, gnu::cold]] std::string reason() const {
    switch (status) {
      case slant::status::converged:
        return "the reduced gradient vanishes";
      case slant::status::unbounded:
        return "the function decreases for ever along a direction of the set";
      case slant::status::stalled:
        return stagnation() + ": " + this->accuracy();
      case slant::status::breakdown:
        return "a number left the range of the scalar, or A is not positive definite on a face";
      default:
        return std::string(to_string(status));
    }
  }

 private:
  [[nodiscard, gnu::cold]] std::string stagnation() const {
    if (last_inner == inner_end::endless) {
      return "along a direction that does not leave the set the curvature is lost in rounding "
             "errors";
    }
    return std::string("neither the reduced gradient nor the function falls any more; the ") +
           (last_inner == inner_end::limit ? "inner iterations end at their limit"
                                           : "active sets may recur");
  }
};

}  // namespace slant
