// SPDX-License-Identifier: MIT
//
// The state of the method of successive approximations.
#pragma once

#include <slant/iteration/report.hpp>
#include <slant/methods/anderson_mixing.hpp>
#include <slant/methods/progress_watch.hpp>
#include <slant/newton/forcing.hpp>

#include <string>

namespace slant {

/// State of successive_approximations with an inner method of states Inner, for vectors V.
template <class Inner, class V>
struct successive_state {
  using vector_type = V;
  using scalar = scalar_t<V>;

  V x;           ///< solution of the inner problem at `parameters`
  V parameters;  ///< p of the last inner problem
  V image;       ///< Ψ(p), of x
  V change;      ///< Ψ(p) − p
  V next;        ///< scratch: the next p
  V r;           ///< gradient at x of the problem at Ψ(p), in multiples of unit
  V reduced;     ///< its reduced gradient
  V trial;       ///< scratch
  V projected;   ///< scratch
  Inner inner;   ///< state of the inner method

  anderson_mixing<V> mixing;          ///< differences of p and Ψ(p) − p
  forcing_history<scalar> forcing{};  ///< residuals and inner tolerances so far
  progress_watch<scalar> progress{};  ///< looks for steps that get nowhere
  scalar relaxation{1};               ///< ω; smaller after plain steps that have failed
  bool solved_once = false;           ///< x is a solution at p, up to η R, and no start
  bool accelerated = false;           ///< the last p is one of Anderson's
  scalar unit{1};                     ///< of r and r̃, a power of two: that of the inner method
  scalar reduced_gradient_norm{0};  ///< ‖r̃‖ at x for the problem at Ψ(p): 0 at a fixed point
  scalar gradient_scale{0};         ///< that of the inner problem
  index inner_iterations = 0;       ///< of the inner method in the last step
  index iteration = 0;
  slant::status status = slant::status::running;
  slant::status inner_status = slant::status::running;  ///< how the last inner solve ended
  slant::work work{};  ///< inner_iterations: steps of the inner method

  /// What a status other than running means here.
  [[nodiscard, gnu::cold]] std::string reason() const {
    switch (status) {
      case slant::status::converged:
        return "x solves the problem that belongs to it";
      case slant::status::stalled:
        return "the fixed point iteration gets no nearer";
      default:
        return "the inner method reports: " + std::string(to_string(inner_status));
    }
  }
};

}  // namespace slant
