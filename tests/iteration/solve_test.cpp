// SPDX-License-Identifier: MIT
#include <slant/iteration/solve.hpp>

#include <support/testing.hpp>
#include "toy_method.hpp"

namespace solve_test {

TEST_CASE("solve stops where the method comes to rest and says so") {
  auto const r = slant::solve(toy::halving{}, 1.0, slant::at_most(100));
  CHECK(r.status == slant::status::converged);
  CHECK(r.converged());
  CHECK(r.iterations() == 10);  // 2⁻¹⁰ < 1e-3 < 2⁻⁹
  CHECK(r.x() == 0x1p-10);
  CHECK(r.reason == "the method reports: converged");
}

TEST_CASE("solve stops when the rule fires, with the rule's words") {
  auto const r = slant::solve(toy::halving{}, 1.0, slant::at_most(3));
  CHECK(r.status == slant::status::iteration_limit);
  CHECK_FALSE(r.converged());
  CHECK(r.iterations() == 3);
  CHECK(r.reason == "reached the limit of 3 steps");
}

TEST_CASE("no step is taken from a start that already satisfies the rule") {
  auto const r = slant::solve(toy::halving{}, 1.0, slant::at_most(0));
  CHECK(r.iterations() == 0);
  CHECK(r.x() == 1.0);
}

TEST_CASE("every observer sees every state once, the first and the last included") {
  std::vector<double> seen;
  int calls = 0;
  auto const r = slant::solve(
      toy::halving{}, 8.0, slant::at_most(3), [&](toy::state const& s) { seen.push_back(s.x); },
      [&](toy::state const&) { ++calls; });
  CHECK(r.iterations() == 3);
  CHECK(seen == std::vector<double>{8, 4, 2, 1});
  CHECK(calls == 4);
}

TEST_CASE("accuracy reached in the last permitted step counts as converged") {
  auto const r =
      slant::solve(toy::halving{}, 1.0, slant::at_most(3) || slant::residual_below(0.125));
  CHECK(r.iterations() == 3);
  CHECK(r.x() == 0.125);
  CHECK(r.converged());
}

/// Its residual halves when a step updates it; in truth it is larger by `drift`, which every
/// refresh brings down to a tenth.
struct drifting {
  struct state {
    double x = 0;
    double residual_norm = 1, residual_scale = 1, drift = 0.5;
    bool updated = false;
    slant::index iteration = 0;
    slant::status status = slant::status::running;
    int refreshes = 0;
  };
  static state start(double) { return {}; }
  static void step(state& s) {
    s.residual_norm /= 2;
    s.updated = true;
    ++s.iteration;
  }
  static bool refresh(state& s) {
    if (!s.updated) return false;
    s.residual_norm += s.drift;
    s.drift /= 10;
    s.updated = false;
    ++s.refreshes;
    return true;
  }
};

TEST_CASE("success counts only for a residual computed from x, and is not asked for otherwise") {
  auto const r = slant::solve(drifting{}, 0.0, slant::residual_below(0.01) || slant::at_most(100));
  CHECK(r.converged());
  CHECK(r.state.residual_norm <= 0.01);
  CHECK(r.state.refreshes == 4);  // 0.5, 0.05 and 0.005 on top are too much
  CHECK_FALSE(r.state.updated);
  auto const limited = slant::solve(drifting{}, 0.0, slant::at_most(20));
  CHECK(limited.state.refreshes == 0);
}

}  // namespace solve_test
