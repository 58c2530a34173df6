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

struct halving_state {
  VectorXd x;
  slant::index iteration = 0;
  slant::status status = slant::status::running;
  slant::work work{};
};

/// x ← factor · x; ends by itself in step `last` with the status `end`.
struct halving {
  double factor = 0.5;
  slant::index last = 1000;
  slant::status end = slant::status::breakdown;

  [[nodiscard]] halving_state start(VectorXd const& x0) const { return {x0}; }
  void step(halving_state& s) const {
    s.x *= factor;
    ++s.work.operator_applications;
    if (++s.iteration == last) s.status = end;
  }
};

auto size_below(double size) {
  return slant::stop_when([size](auto const& s) { return s.x.norm() <= size; }, "small enough",
                          slant::status::converged);
}

TEST_CASE("the second method goes on where the first one ends; counts and words of both") {
  VectorXd const x0 = VectorXd::Unit(3, 1);
  slant::index seen = 0;
  auto const r =
      slant::solve_then(halving{}, size_below(0.1), halving{.factor = 0.1}, x0,
                        size_below(1e-4) || slant::at_most(50), [&](auto const&) { ++seen; });
  CHECK(r.converged());
  CHECK(r.status() == slant::status::converged);
  CHECK(r.first.iterations() == 4);
  REQUIRE(r.second.has_value());
  CHECK(r.second->iterations() == 3);
  CHECK(r.x()(1) == doctest::Approx(1.0 / 16 * 1e-3));
  CHECK(r.iterations() == 7);
  CHECK(r.work().operator_applications == 7);
  CHECK(seen == 5 + 4);
  CHECK(r.reason() == "first phase: small enough; second phase: small enough");
}

TEST_CASE("the second method may be made from the last state of the first") {
  VectorXd const x0 = VectorXd::Unit(3, 1);
  auto const r = slant::solve_then(
      halving{}, size_below(0.1),
      [](halving_state const& last) { return halving{.factor = last.x.norm()}; }, x0,
      size_below(1e-4) || slant::at_most(50));
  CHECK(r.converged());
  CHECK(r.second->iterations() == 3);
  CHECK(r.x()(1) == doctest::Approx(std::pow(2.0, -4 * 4)));
}

TEST_CASE("a limit or a stall hands over; a failure is reported and ends it") {
  VectorXd const x0 = VectorXd::Ones(2);
  auto const run = [&](slant::status end) {
    return slant::solve_then(halving{.last = 2, .end = end}, slant::at_most(5), halving{}, x0,
                             size_below(1e-3) || slant::at_most(50));
  };
  CHECK(run(slant::status::stalled).converged());
  CHECK(run(slant::status::iteration_limit).first.status == slant::status::iteration_limit);
  CHECK(run(slant::status::iteration_limit).converged());
  for (auto const end :
       {slant::status::breakdown, slant::status::unbounded, slant::status::interrupted}) {
    auto const r = run(end);
    CHECK_FALSE(r.converged());
    CHECK_FALSE(r.second.has_value());
    CHECK(r.status() == end);
    CHECK(r.iterations() == 2);
    CHECK(r.work().operator_applications == 2);
    CHECK(r.x()(0) == 0.25);
    CHECK(r.reason() == "first phase: the method reports: " + std::string(slant::to_string(end)) +
                            "; no second phase");
  }
  // An iterate that is not finite starts nothing.
  auto const r = slant::solve_then(halving{.factor = 1e200}, slant::at_most(2), halving{}, x0,
                                   slant::at_most(1));
  CHECK_FALSE(r.second.has_value());
  CHECK(r.status() == slant::status::iteration_limit);
}

}  // namespace solve_test
