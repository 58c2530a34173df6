// SPDX-License-Identifier: MIT
//
// One run of one method on the dual problem, in a form that all methods share.
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <slant/iteration/solve.hpp>
#include <slant/iteration/stopping.hpp>
#include <string>
#include <utility>

namespace from_files {

using clock = std::chrono::steady_clock;

/// What the user asks of a method.
struct settings {
  double tolerance = 1e-8;  ///< relative norm of the reduced gradient
  slant::index max_iterations = 1000000;
};

/// What came of it.
struct outcome {
  slant::status status;
  std::string reason;  ///< the status as a sentence
  slant::index iterations;
  slant::work work;
  clock::time_point started;  ///< when the first iterate was ready: all before is set-up
  Eigen::VectorXd λ;          ///< (normal, tangential)
};

/// Runs a method for the dual problem whose state measures the reduced gradient.
template <class Method>
[[nodiscard]] outcome run_on_dual(Method const& method, Eigen::VectorXd const& x0,
                                  settings const& s) {
  clock::time_point started;
  auto const note_start = [&](auto const& state) {
    if (state.iteration == 0) started = clock::now();
  };
  auto report = slant::solve(
      method, x0, slant::reduced_gradient_below(s.tolerance) || slant::at_most(s.max_iterations),
      note_start);
  slant::index const iterations = report.iterations();
  return {.status = report.status,
          .reason = std::move(report.reason),
          .iterations = iterations,
          .work = report.state.work,
          .started = started,
          .λ = std::move(report.state.x)};
}

}  // namespace from_files
