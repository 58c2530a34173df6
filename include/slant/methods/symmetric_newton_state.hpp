// SPDX-License-Identifier: MIT
//
// The state of the symmetric semismooth Newton method.
#pragma once

#include <slant/iteration/report.hpp>
#include <slant/methods/curved_minimum.hpp>
#include <slant/methods/descent_takeover.hpp>
#include <slant/methods/gradient_point.hpp>
#include <slant/methods/newton_segment.hpp>
#include <slant/methods/progress_watch.hpp>
#include <slant/methods/rounded_products.hpp>
#include <slant/newton/forcing.hpp>
#include <slant/sets/curved_face.hpp>

#include <string>

namespace slant {

/// The steps of symmetric_newton.
enum class symmetric_newton_step : unsigned char { none, full, damped, descent };

/// State of symmetric_newton for a separable_qp of type QP with the preconditioner M. x ∈ Λ with
/// its gradient r, computed from x, and its reduced gradient are those of gradient_point.
template <class QP, class M>
struct symmetric_newton_state : gradient_point<QP> {
  using typename gradient_point<QP>::vector_type;
  using typename gradient_point<QP>::scalar;

  newton_segment<vector_type> segment;   ///< y, z of Newton's iterate; x = P_Λ(z) after a step
  curved_face<scalar> face;              ///< range(G) and C at z
  curved_minimum<vector_type, M> inner;  ///< the step t on it
  rounded_products<typename QP::operator_type, vector_type> products;  ///< what it spends
  forcing_history<scalar> forcing{};  ///< errors and inner tolerances so far
  progress_watch<scalar> progress;    ///< looks for steps that get nowhere
  descent_takeover<QP> descent;       ///< the method that takes over where Newton's fails

  scalar residual_norm{0};  ///< ‖F(y)‖/ρ = ‖y − P_Λ(z)‖/ρ, in units of the gradient
  scalar preconditioner_size{1};  ///< s = mean(diag M)
  bool at_projection = false;     ///< x = P_Λ(z)
  symmetric_newton_step last_step = symmetric_newton_step::none;
  scalar step_fraction{1};     ///< β of the last Newton step
  index inner_iterations = 0;  ///< of the last Newton step
  index iteration = 0;
  slant::status status = slant::status::running;

  symmetric_newton_state(QP const& qp, M const& m, vector_type const& x0)
      : gradient_point<QP>(qp, x0),
        segment(x0, qp.size()),
        face(qp.set()),
        inner(x0, qp.size(), m),
        products(qp.a(), x0) {}

  /// What a status other than running means here.
  [[nodiscard, gnu::cold]] std::string reason() const;
};

template <class QP, class M>
std::string symmetric_newton_state<QP, M>::reason() const {
  switch (status) {
    case slant::status::converged:
      return "the reduced gradient is zero: x is the solution";
    case slant::status::stalled:
      return "no step lowers the residual any further at this precision: " + this->accuracy();
    case slant::status::breakdown:
      return "a number left the range of the scalar, or A is not semidefinite";
    case slant::status::unbounded:
      return "the function decreases for ever along −descent.state()->directions.p";
    default:
      return std::string(to_string(status));
  }
}

}  // namespace slant
