// SPDX-License-Identifier: MIT
//
// The driver, the range of iterates and the rules ask their archetypes for nothing more.
#include <slant/iteration/iterates.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/testing/archetypes.hpp>

#include <doctest/doctest.h>

namespace iteration_archetypes_test {

namespace archetype = slant::testing::archetype;

TEST_CASE("solve runs a minimal method to its end, or to that of a minimal rule") {
  archetype::iterative_method const method;
  archetype::observer seen;
  auto const r = slant::solve(method, 5, archetype::stopping_rule(0), seen);
  CHECK(r.converged());
  CHECK(r.iterations() == 5);
  CHECK(seen.seen() == 7);  // six numbers, and the state that came to rest
  auto const stopped = slant::solve(method, 5, archetype::stopping_rule(3) || slant::at_most(10));
  CHECK(stopped.status == slant::status::interrupted);
  CHECK(stopped.reason == "below");
  CHECK(stopped.x() == 2);
  CHECK(slant::solve(method, 5, archetype::stopping_rule(3) && slant::at_most(4)).x() == 1);
}

TEST_CASE("iterates shows the states of a minimal method") {
  archetype::iterative_method const method;
  int sum = 0;
  for (auto const& s : slant::iterates(method, 4)) sum += s.x;
  CHECK(sum == 4 + 3 + 2 + 1);
}

}  // namespace iteration_archetypes_test
