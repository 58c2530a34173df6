// SPDX-License-Identifier: MIT
#include <slant/iteration/iterates.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/testing/archetypes.hpp>

#include <range/v3/view/take.hpp>
#include <range/v3/view/take_while.hpp>
#include <range/v3/view/transform.hpp>
#include <support/testing.hpp>
#include "toy_method.hpp"

namespace iterates_test {

namespace archetype = slant::testing::archetype;

TEST_CASE("iterates begins with the start and ends behind the state at rest") {
  toy::halving method;
  std::vector<double> seen;
  for (auto const& s : slant::iterates(method, 1.0)) seen.push_back(s.x);
  REQUIRE(seen.size() == 11);
  CHECK(seen.front() == 1.0);
  CHECK(seen.back() == 0x1p-10);
}

TEST_CASE("iterates goes through range-v3 pipelines") {
  toy::halving method;
  std::vector<double> seen;
  auto run = slant::iterates(method, 1.0);
  for (double x : run | ranges::views::take_while([](toy::state const& s) { return s.x > 0.1; }) |
                      ranges::views::transform([](toy::state const& s) { return 2 * s.x; })) {
    seen.push_back(x);
  }
  CHECK(seen == std::vector<double>{2, 1, 0.5, 0.25});
}

TEST_CASE("a temporary method lives in the range, which may outlive the scope of its making") {
  struct by_own_factor {
    std::vector<double> factor;  // on the heap: a dangling method would show
    toy::state start(double x0) const { return {.x = x0}; }
    void step(toy::state& s) {
      s.x *= factor.front();
      if (++s.iteration == 3) s.status = slant::status::converged;
    }
  };
  auto const make = [] { return slant::iterates(by_own_factor{{0.25}}, 1.0); };
  auto run = make();
  std::vector<double> seen;
  for (auto const& s : run) seen.push_back(s.x);
  CHECK(seen == std::vector<double>{1, 0.25, 0.0625, 0.015625});

  struct unmoved : toy::halving {  // its states refer to it
    struct pointing : toy::state {
      unmoved const* maker = nullptr;
    };
    pointing start(double x0) const { return {toy::state{.x = x0}, this}; }
    void step(pointing& s) {
      CHECK(s.maker == this);
      s.status = slant::status::converged;
    }
  };
  int states = 0;
  for ([[maybe_unused]] auto const& s : slant::iterates(unmoved{}, 1.0)) ++states;
  CHECK(states == 2);
}

TEST_CASE("taking n states performs n - 1 steps") {
  struct counting : toy::halving {
    int steps = 0;
    void step(toy::state& s) {
      ++steps;
      toy::halving::step(s);
    }
  } method;
  int states = 0;
  for ([[maybe_unused]] auto const& s : slant::iterates(method, 1.0) | ranges::views::take(4))
    ++states;
  CHECK(states == 4);
  CHECK(method.steps <= 4);  // the view may look one ahead, never more
}

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

}  // namespace iterates_test
