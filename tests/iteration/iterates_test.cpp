// SPDX-License-Identifier: MIT
#include "toy_method.hpp"

#include <slant/iteration/iterates.hpp>

#include <doctest/doctest.h>
#include <range/v3/view/take.hpp>
#include <range/v3/view/take_while.hpp>
#include <range/v3/view/transform.hpp>

#include <vector>

namespace iterates_test {

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

TEST_CASE("taking n states performs n - 1 steps") {
  struct counting : toy::halving {
    int steps = 0;
    void step(toy::state& s) {
      ++steps;
      toy::halving::step(s);
    }
  } method;
  int states = 0;
  for ([[maybe_unused]] auto const& s : slant::iterates(method, 1.0) | ranges::views::take(4)) {
    ++states;
  }
  CHECK(states == 4);
  CHECK(method.steps <= 4);  // the view may look one ahead, never more
}

}  // namespace iterates_test
