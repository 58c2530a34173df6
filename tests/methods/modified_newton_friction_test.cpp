// SPDX-License-Identifier: MIT
//
// MSSN, IMSSN, GIMSSN, AS, AS-S and QPQ on plane friction: half lines and intervals.
#include <slant/contact/dual.hpp>
#include <slant/contact/optimality.hpp>
#include <slant/factorizations/factorize.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/methods/kprgp.hpp>
#include <slant/methods/mssn.hpp>

#include <doctest/doctest.h>

#include <contact/scenes.hpp>
#include <string>

namespace modified_newton_friction_test {

TEST_CASE("plane friction: all reach the independent reference, with few products") {
  auto const scene = fem::make_steel_brick({.k = 2, .load = fem::brick_load::pull});
  auto const data = test::one_tangent(scene);
  auto const reference = test::reference(scene.K, data);
  slant::contact::dual const dual(slant::contact::friction_line{}, slant::factorize(scene.K), data);
  auto const qp = dual.qp();
  auto const check = [&](std::string const& name, auto const& method, slant::index products) {
    CAPTURE(name);
    auto const r = slant::solve(method, dual.zero(),
                                slant::reduced_gradient_below(1e-9) || slant::at_most(2000));
    REQUIRE(r.converged());
    auto const u = dual.displacement(r.x());
    CHECK(oracle::energy_error(scene.K, u, reference.u) <= 1e-6);
    CHECK(slant::contact::check_optimality(scene.K, data, u, r.x()).residual() <= 1e-7);
    CHECK(r.state.work.operator_applications <= products);
    return r.iterations();
  };
  // On intervals there is no curvature to lose: MSSN is semismooth Newton and ends in few steps.
  CHECK(check("mssn", slant::mssn{qp}, 200) <= 10);
  check("imssn", slant::imssn{qp}, 100);
  check("gimssn", slant::gimssn{qp}, 120);
  check("as_s", slant::as_s(qp), 65);
  check("as", slant::as(qp), 55);
  check("qpq", slant::qpq{qp}, 55);
}

// [K Ex 5, Table 5]: α̃ = ρ = β/σ_max with β far beyond 2 needs fewer products; AS then oscillates
// where AS-S has been stabilised.
TEST_CASE("steps beyond 2/σ_max: AS oscillates, AS-S and IMSSN converge") {
  auto const scene = fem::make_steel_brick({.k = 2, .load = fem::brick_load::lift});
  auto const data = test::one_tangent(scene);
  slant::contact::dual const dual(slant::contact::friction_line{}, slant::factorize(scene.K), data);
  auto const qp = dual.qp();
  auto const stop = slant::reduced_gradient_below(1e-6) || slant::at_most_applications(1000);
  double const safe = slant::gimssn{qp}.start(dual.zero()).step_length;  // 1.9/σ_max
  for (double β : {8.0, 15.0, 20.0}) {
    CAPTURE(β);
    double const α = β / 1.9 * safe;
    auto const stable = slant::solve(slant::as_s(qp, {.step_length = α}), dual.zero(), stop);
    REQUIRE(stable.converged());
    CHECK(stable.state.work.operator_applications <= 40);
    auto const i = slant::solve(slant::imssn{qp, {.step_length = α}}, dual.zero(), stop);
    CHECK(i.converged());
    CHECK((i.x() - stable.x()).norm() <= 1e-4 * i.x().norm());
    CHECK_FALSE(slant::solve(slant::as(qp, {.step_length = α}), dual.zero(), stop).converged());
  }
}

}  // namespace modified_newton_friction_test
