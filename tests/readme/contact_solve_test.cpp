// SPDX-License-Identifier: MIT
#include <slant/contact/solve.hpp>

#include <doctest/doctest.h>

#include <fem/steel_brick.hpp>

TEST_CASE("contact in three lines") {
  auto const brick = fem::make_steel_brick({.k = 1, .load = fem::brick_load::lift});
  auto const& K = brick.K;
  slant::contact::data<double> const data{brick.N, brick.T, brick.f, brick.d, brick.g};

  slant::contact::friction_disc const law;  // with the law named no other is compiled
  auto const r = slant::contact::solve(law, K, data, {.tolerance = 1e-8});
  if (!r.converged()) FAIL(r.reason);       // else r.u, r.multipliers, r.error, r.condition
  double const error = r.error.relative();  // an estimate; {.prove = true}: a bound

  CHECK(error <= 1e-8);
}
