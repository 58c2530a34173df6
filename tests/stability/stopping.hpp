// SPDX-License-Identifier: MIT
//
// How runs are stopped: the one place to change for another rule. As the command line does, each
// method by the norm that it judges itself by.
#pragma once

#include <slant/iteration/solve.hpp>
#include <slant/iteration/step_below.hpp>
#include <slant/iteration/stopping.hpp>

#include <stability/methods.hpp>
#include <utility>

namespace stability {

/// Methods whose state measures the reduced gradient.
[[nodiscard]] inline auto by_gradient(prepared const&, request const& r) {
  return slant::reduced_gradient_below(r.tolerance) || slant::at_most(r.steps) ||
         slant::at_most_applications(r.applications);
}
/// Methods for an equation.
[[nodiscard]] inline auto by_residual(prepared const&, request const& r) {
  return slant::residual_below(r.tolerance) || slant::at_most(r.steps) ||
         slant::at_most_applications(r.applications);
}
/// Methods for larger systems.
[[nodiscard]] inline auto by_step(prepared const&, request const& r) {
  return slant::step_below(r.tolerance) || slant::at_most(std::min<slant::index>(r.steps, 1000)) ||
         slant::at_most_applications(r.applications);
}

/// Runs a method; back(y) is the point of Λ that its last iterate stands for.
template <class Method, class Rule, class Back>
[[nodiscard]] outcome run_until(Method const& m, Eigen::VectorXd const& y0, Rule rule,
                                Back const& back) {
  auto report = slant::solve(m, y0, std::move(rule));
  outcome o;
  o.status = report.status;
  o.reason = std::move(report.reason);
  o.iterations = report.iterations();
  o.applications = report.state.work.operator_applications;
  o.x = back(std::as_const(report.state.x));
  return o;
}

}  // namespace stability
