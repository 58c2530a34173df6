// SPDX-License-Identifier: MIT
//
// The state of semismooth_newton: everything that one step hands to the next, and all vectors it
// works in.
#pragma once

#include <slant/concepts/slanting_function.hpp>
#include <slant/iteration/report.hpp>
#include <slant/methods/progress_watch.hpp>
#include <slant/newton/direction.hpp>
#include <slant/newton/forcing.hpp>

#include <limits>
#include <string>

namespace slant {

/// What ended a run of semismooth_newton, beside success.
enum class newton_failure : unsigned char {
  none,          ///< nothing has
  no_direction,  ///< the linear solver found no dy with ‖F + F° dy‖ < ‖F‖
  not_finite,    ///< F left the range of the scalar where the step leads
  no_length,     ///< no length was accepted by the globalisation
  no_digits,     ///< steps are down to the last digit of y, and ‖F‖ falls no more
  no_progress    ///< ‖F‖ has had no new smallest value for `patience` steps
};

/// State of semismooth_newton for F on vectors V with a solver of type Solver. slant_operator
/// refers to F, so it must not be applied after F is gone; all the rest may be used.
template <class F, class V, class Solver>
struct newton_state {
  using vector_type = V;
  using scalar = scalar_t<V>;
  using slant_type = slant_operator_t<F, V>;

  V x;                                         ///< iterate y
  V residual;                                  ///< F(y)
  V direction;                                 ///< dy of the last step
  V trial;                                     ///< y + α dy
  V trial_residual;                            ///< F(y + α dy)
  slant_type slant_operator;                   ///< F°(y)
  workspace_t<F, V> f_workspace;               ///< temporaries of F
  prepared_t<Solver, slant_type, V> prepared;  ///< what the linear solver keeps

  scalar residual_norm{0};   ///< ‖F(y)‖
  scalar residual_scale{0};  ///< what ‖F(y)‖ is small against; see newton_scale
  scalar step_norm = std::numeric_limits<scalar>::infinity();  ///< ‖dy‖, or ‖α dy‖ if α > 1: a step
                                                               ///< that was shortened says nothing
                                                               ///< about the distance to go
  scalar x_norm{0};                   ///< ‖y‖
  scalar length{0};                   ///< α of the last step
  scalar linear_residual{0};          ///< ‖F + F° dy‖ of the last step
  forcing_history<scalar> forcing{};  ///< errors, and η of the last step
  progress_watch<scalar> progress{};  ///< looks for steps that get nowhere

  index inner_iterations = 0;  ///< of the linear solver in the last step
  index trials = 0;            ///< evaluations of F in the last step, 1 without shortening
  index iteration = 0;
  slant::status status = slant::status::running;
  newton_failure failure = newton_failure::none;         ///< why, if status says failure
  slant::status solver_status = slant::status::running;  ///< how the last linear solve ended
  slant::work work{};  ///< operator_applications: evaluations of F and applications of F° or its
                       ///< parts; for a natural residual each is one product by A

  /// Ends the run; false, for callers that return whether they succeeded.
  bool give_up(slant::status how, newton_failure why) {
    status = how;
    failure = why;
    return false;
  }
  /// The same where no step was made: the size of its direction, 0 perhaps, is no sign of success.
  bool give_up_step(slant::status how, newton_failure why) {
    step_norm = std::numeric_limits<scalar>::infinity();
    return give_up(how, why);
  }

  /// What a status other than running means here.
  [[nodiscard, gnu::cold]] std::string reason() const {
    switch (failure) {
      case newton_failure::no_direction:
        return "the linear solver found no direction along which F decreases (" +
               std::string(to_string(solver_status)) + "): F° may be singular";
      case newton_failure::not_finite:
        return "F is not finite where the step leads";
      case newton_failure::no_length:
        return "no step length along the Newton direction decreases the residual enough";
      case newton_failure::no_digits:
        return "steps change but the last digits of the iterate, and the residual falls no more";
      case newton_failure::no_progress:
        return "the residual has not fallen for many steps";
      default:
        return status == slant::status::converged ? "the residual vanishes"
                                                  : std::string(to_string(status));
    }
  }
};

}  // namespace slant
