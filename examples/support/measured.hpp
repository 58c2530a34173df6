// SPDX-License-Identifier: MIT
//
// What a table tells of a run, and how the documents write it: [T] products/iterations, [K]
// iterations/products.
#pragma once

#include <slant/base/report.hpp>
#include <string>

namespace examples {

/// Work and outcome of one run.
struct measured {
  slant::index steps = 0;
  slant::index products = 0;  ///< applications of A in the iteration
  slant::index setup = 0;     ///< and before it
  slant::status status = slant::status::running;

  [[nodiscard]] bool converged() const { return status == slant::status::converged; }
};

/// Takes the numbers out of a report.
template <class State>
[[nodiscard]] measured measure(slant::report<State> const& report) {
  return {.steps = report.iterations(),
          .products = report.state.work.operator_applications,
          .setup = report.state.work.setup_applications,
          .status = report.status};
}

/// "161/10" as in [T]; for a run without success its status instead.
[[nodiscard]] inline std::string products_and_steps(measured const& run) {
  if (!run.converged()) return std::string(to_string(run.status));
  return std::to_string(run.products) + "/" + std::to_string(run.steps);
}

/// "10/161" as in [K]; for a run without success its status instead.
[[nodiscard]] inline std::string steps_and_products(measured const& run) {
  if (!run.converged()) return std::string(to_string(run.status));
  return std::to_string(run.steps) + "/" + std::to_string(run.products);
}

}  // namespace examples
