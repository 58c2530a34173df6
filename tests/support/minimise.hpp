// SPDX-License-Identifier: MIT
#pragma once

#include <slant/iteration/solve.hpp>

#include <support/testing.hpp>
#include <utility>

namespace test {

/// The run of a method from x0 until the relative reduced gradient is below the tolerance.
template <class Method, class X, class S>
[[nodiscard]] auto minimise(Method&& method, X const& x0, S tolerance, slant::index most_steps) {
  return slant::solve(std::forward<Method>(method), x0,
                      slant::reduced_gradient_below(tolerance) || slant::at_most(most_steps));
}

/// A method from the state s, where its point is y, takes the steps of Newton's for F(y) = 0.
template <class Method, class State, class Newton, class Y>
void check_same_steps(Method const& method, State& s, Newton const& newton, Y const& y) {
  auto g = newton.start(s.x);
  int compared = 0;
  for (int k = 0; k < 12 && s.status == slant::status::running; ++k) {
    method.step(s);
    if (s.step_fraction != 1.0) break;  // the two searches differ
    newton.step(g);
    if (g.length != 1.0) break;
    CHECK((y - g.x).norm() <= 1e-10 * (1 + g.x.norm()));
    ++compared;
  }
  CHECK(compared >= 3);
}

}  // namespace test
