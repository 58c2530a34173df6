// SPDX-License-Identifier: MIT
//
// How runs are stopped: all methods by the same rule, the energy error that a certificate shows.
#pragma once

#include <slant/certificates/energy_error.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/iteration/stopping.hpp>

#include <stability/methods.hpp>
#include <utility>

namespace stability {

/// Runs a method from y0; back(y) is the point of Λ that an iterate stands for.
template <class Method, class Back>
[[nodiscard]] outcome run_until(Method const& m, Eigen::VectorXd const& y0, prepared const& p,
                                request const& r, Back const& back) {
  auto const error_of = [&](Eigen::VectorXd const& y) { return p.error_of(back(y), r.tolerance); };
  auto report =
      slant::solve(m, y0,
                   slant::energy_error_below(r.tolerance, error_of) || slant::at_most(r.steps) ||
                       slant::at_most_applications(r.applications));
  outcome o;
  o.status = report.status;
  o.reason = std::move(report.reason);
  o.iterations = report.iterations();
  o.applications = report.state.work.operator_applications;
  o.x = back(std::as_const(report.state.x));
  o.claimed = o.x.allFinite() ? p.error_of(o.x, r.tolerance).relative() : o.claimed;
  return o;
}

}  // namespace stability
