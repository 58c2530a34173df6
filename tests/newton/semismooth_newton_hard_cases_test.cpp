// SPDX-License-Identifier: MIT
//
// Starts and data that are legal and unkind.
#include <slant/iteration/solve.hpp>
#include <slant/newton/semismooth_newton.hpp>

#include <newton/newton_scene.hpp>

#include <doctest/doctest.h>

#include <limits>

namespace semismooth_newton_hard_cases_test {

using Eigen::VectorXd;

constexpr int m = 8;
constexpr double smallest_radius = 1e-3;

TEST_CASE("bad starts: far away, infeasible, random") {
  newton_scene::data const d(m);
  auto const A = d.definite();
  auto const F =
      slant::natural_residual(A, d.b, newton_scene::contact_set(m, smallest_radius), d.ρ);
  auto const stop = slant::residual_below(1e-10) || slant::at_most(200);
  VectorXd const solution = slant::solve(slant::semismooth_newton{F}, d.zero(), stop).x();
  for (double size : {1.0, 1e3, 1e10}) {
    for (unsigned seed : {1U, 2U, 3U}) {
      VectorXd const x0 = size * slanting_support::random_vector(3 * m, seed);
      auto const r = slant::solve(slant::semismooth_newton{F}, x0, stop);
      CAPTURE(size);
      CHECK(r.converged());
      CHECK((r.x() - solution).norm() <= 1e-8 * solution.norm());
      CHECK(r.state.residual_scale == slant::norm(slant::evaluate(F, d.zero())));
    }
  }
}

TEST_CASE("slip bounds of zero and infinity: points and free pairs") {
  newton_scene::data const d(4);
  auto const A = d.definite();
  double const infinity = std::numeric_limits<double>::infinity();
  auto const set =
      slant::cartesian(slant::power(slant::half_line<>{}, 4),
                       slant::power(slant::ball<2>{}, VectorXd{{0.0, infinity, 0.5, 0.0}}));
  auto const F = slant::natural_residual(A, d.b, set, d.ρ);
  auto const stop = slant::residual_below(1e-13) || slant::at_most(60);
  auto const check = [&](auto const& method) {
    auto const r = slant::solve(method, d.zero(), stop);
    REQUIRE(r.converged());
    VectorXd const x = r.x(), force = d.A * x - d.b;
    CHECK(x.segment<2>(4).norm() <= 1e-12);
    CHECK(x.segment<2>(10).norm() <= 1e-12);
    CHECK(force.segment<2>(6).norm() <= 1e-11);
    CHECK(x.segment<2>(8).norm() <= 0.5 * (1 + 1e-12));
  };
  check(slant::semismooth_newton{F});
  check(slant::semismooth_newton{F, slant::direct_solver{}});
  // Weak contact: bounds that are active without a force.
  auto const G = slant::natural_residual(A, d.zero(), set, d.ρ);
  auto const r =
      slant::solve(slant::semismooth_newton{G}, slanting_support::random_vector(12, 3), stop);
  CHECK(r.converged());
  CHECK(r.x().norm() <= 1e-12);
}

}  // namespace semismooth_newton_hard_cases_test
