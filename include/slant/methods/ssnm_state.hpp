// SPDX-License-Identifier: MIT
//
// The state of SSNM: everything that one step hands to the next, and all vectors it works in.
#pragma once

#include <slant/concepts/slanting_function.hpp>
#include <slant/iteration/report.hpp>
#include <slant/newton/direction.hpp>
#include <slant/newton/forcing.hpp>

#include <limits>
#include <string>

namespace slant {

/// State of ssnm for the function F, vectors V and a linear solver.
template <class F, class V, class Solver>
struct ssnm_state {
  using scalar = scalar_t<V>;
  using slant_type = slant_operator_t<F, V>;

  V x;                                         ///< iterate
  V multipliers;                               ///< z, one per inequality
  V y;                                         ///< (x, z)
  V residual;                                  ///< F(y)
  V direction;                                 ///< dy of the last step
  slant_type slant_operator;                   ///< F°(y)
  workspace_t<F, V> f_workspace;               ///< temporaries of F
  prepared_t<Solver, slant_type, V> prepared;  ///< what the linear solver keeps

  scalar residual_norm{0};                                     ///< ‖F(y)‖
  scalar residual_scale{0};                                    ///< ‖b‖
  scalar step_norm = std::numeric_limits<scalar>::infinity();  ///< ‖x⁺ − x‖ of the last step
  scalar x_norm{0};                                            ///< ‖x‖
  scalar linear_residual{0};          ///< ‖F + F° dy‖ of the last step
  forcing_history<scalar> forcing{};  ///< err, and tol of the last step

  index inner_iterations = 0;  ///< of the linear solver in the last step
  index active = 0;            ///< inequalities in 𝒜 at y
  index iteration = 0;
  slant::status status = slant::status::running;
  slant::status solver_status = slant::status::running;  ///< how the last linear solve ended
  slant::work work{};  ///< operator_applications: those of K⁻¹ in schur_bicgstab and schur_cg,
                       ///< those of F° in bicgstab_solver; evaluations of F are `iteration` + 1

  /// What a status other than running means here.
  [[nodiscard, gnu::cold]] std::string reason() const {
    switch (status) {
      case slant::status::converged:
        return "the optimality conditions hold exactly";
      case slant::status::breakdown:
        return "the Newton system could not be solved (" + std::string(to_string(solver_status)) +
               "): A + Σ z ∇²f is singular, or not definite where the solver needs it, or an "
               "active "
               "gradient vanishes or depends on others";
      case slant::status::stalled:
        return "no direction reduces ‖F‖ any more: it is down to rounding, or the inner iteration "
               "stagnates (" +
               std::string(to_string(solver_status)) + ")";
      default:
        return std::string(to_string(status));
    }
  }
};

}  // namespace slant
