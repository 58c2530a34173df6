// SPDX-License-Identifier: MIT
//
// One run of one method, in a form that all methods share.
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <functional>
#include <slant/certificates/energy_error.hpp>
#include <slant/concepts/convex_set.hpp>
#include <slant/contact/node_layout.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/iteration/stopping.hpp>
#include <string>
#include <utility>

#include "any_dual.hpp"

namespace from_files {

using clock = std::chrono::steady_clock;

/// Where a method starts: where it would by itself (λ = 0 for all but the recommended one), λ = 0,
/// or where another method has reduced the reduced gradient to a tenth.
enum class start_point { automatic, zero, qpc, interior_point };

/// λ → its error. One type for all friction laws and factorisations; asked a few times in a run.
using certificate = std::function<slant::energy_error<double>(Eigen::VectorXd const&)>;

/// What the user asks of a method.
struct settings {
  double tolerance = 1e-8;  ///< of the relative error in the energy norm
  slant::index max_iterations = 1000000;
  start_point start = start_point::automatic;
  bool prove = false;        ///< the bound of the error is to be proven
  bool stops_early = false;  ///< a first phase: at this relative reduced gradient
  slant::contact::node_layout<double> layout{};  ///< gives free motions their names
  certificate error_of{};  ///< of the multipliers; set when the problem is known
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

/// A method for the dual problem, to the error that is asked for.
template <class Method>
[[nodiscard]] outcome run_on_dual(Method const& method, Eigen::VectorXd const& λ0,
                                  settings const& s) {
  auto const itself = [](auto const& λ) { return λ; };
  if constexpr (requires { method.start(λ0).reduced_gradient_norm; }) {
    if (s.stops_early)
      return run_until(method, λ0, slant::reduced_gradient_below(s.tolerance), s, itself);
  }
  return run_until(method, λ0, slant::energy_error_below(s.tolerance, s.error_of), s, itself);
}

/// A method whose iterates leave Λ: the nearest point of Λ is judged, and the result.
template <class Method>
[[nodiscard]] outcome run_and_project(Method const& method, Eigen::VectorXd const& λ0,
                                      settings const& s, any_dual const& dual) {
  return run_until(method, λ0, slant::energy_error_below(s.tolerance, s.error_of), s,
                   [&](auto const& λ) { return slant::project(dual.set(), λ); });
}

}  // namespace from_files
