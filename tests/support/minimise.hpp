// SPDX-License-Identifier: MIT
#pragma once

#include <slant/iteration/solve.hpp>

#include <utility>

namespace test {

/// The run of a method from x0 until the relative reduced gradient is below the tolerance.
template <class Method, class X, class S>
[[nodiscard]] auto minimise(Method&& method, X const& x0, S tolerance, slant::index most_steps) {
  return slant::solve(std::forward<Method>(method), x0,
                      slant::reduced_gradient_below(tolerance) || slant::at_most(most_steps));
}

}  // namespace test
