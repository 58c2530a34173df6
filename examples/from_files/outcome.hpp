// SPDX-License-Identifier: MIT
//
// One run of one method, in a form that all methods share.
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <slant/concepts/convex_set.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/iteration/stopping.hpp>
#include <string>
#include <utility>

namespace from_files {

using clock = std::chrono::steady_clock;

/// Where a method starts: λ = 0, or where another method has reduced the reduced gradient to a
/// tenth.
enum class start_point { zero, qpc, interior_point };

/// What the user asks of a method.
struct settings {
  double tolerance = 1e-8;  ///< relative, of the norm that the method judges itself by
  slant::index max_iterations = 1000000;
  start_point start = start_point::zero;
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

/// Runs a method from y0 until the rule fires or the limit of steps is reached; multipliers(y) is λ
/// of its last iterate.
template <class Method, class Rule, class Multipliers>
[[nodiscard]] outcome run_until(Method const& method, Eigen::VectorXd const& y0, Rule accurate,
                                settings const& s, Multipliers multipliers) {
  clock::time_point started;
  auto const note_start = [&](auto const& state) {
    if (state.iteration == 0) started = clock::now();
  };
  auto report =
      slant::solve(method, y0, std::move(accurate) || slant::at_most(s.max_iterations), note_start);
  slant::index const iterations = report.iterations();
  return {.status = report.status,
          .reason = std::move(report.reason),
          .iterations = iterations,
          .work = report.state.work,
          .started = started,
          .λ = multipliers(std::as_const(report.state.x))};
}

/// A method for the dual problem whose state measures the reduced gradient.
template <class Method>
[[nodiscard]] outcome run_on_dual(Method const& method, Eigen::VectorXd const& λ0,
                                  settings const& s) {
  return run_until(method, λ0, slant::reduced_gradient_below(s.tolerance), s,
                   [](auto const& λ) { return λ; });
}

/// A method whose iterates leave Λ: the nearest point of Λ is the result.
template <class Method, class Rule, class Dual>
[[nodiscard]] outcome run_and_project(Method const& method, Eigen::VectorXd const& λ0,
                                      Rule accurate, settings const& s, Dual const& dual) {
  return run_until(method, λ0, std::move(accurate), s,
                   [&](auto const& λ) { return slant::project(dual.set(), λ); });
}

}  // namespace from_files
