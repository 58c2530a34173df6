// SPDX-License-Identifier: MIT
//
// certified_coulomb without factors, against its methods for the forces with factors.
#include <slant/contact/certified_coulomb.hpp>

#include <slant/contact/optimality.hpp>
#include <slant/contact/solve.hpp>

#include <fem/two_bricks.hpp>
#include <fem/two_plates.hpp>
#include <support/testing.hpp>
#include "facing_bricks.hpp"
#include "loose_brick.hpp"
#include "scenes.hpp"

namespace iterated_coulomb_test {

using contact::solution_route;
using options = contact::certified_coulomb_options<double>;

struct scene {
  sparse K;
  contact::data<double> data;
  VectorXd F;
  contact::node_layout<double> layout;
};

template <int D>
scene scene_of(fem::contact_scene<D> const& s, double F) {
  return {s.K,
          {s.N, s.T, s.f, s.d, VectorXd::Zero(s.d.size())},
          VectorXd::Constant(s.d.size(), F),
          contact::layout_of(s.mesh.nodes, s.unknowns.first)};
}

scene brick(int k, fem::brick_load load, double F) {
  return scene_of(fem::make_steel_brick({.k = k, .load = load}), F);
}

auto solve(scene const& s, options o = {}) {
  o.layout = s.layout;
  if (s.data.tangents() == 1)
    return contact::certified_coulomb(contact::friction_line{}, s.K, s.data, s.F, o);
  return contact::certified_coulomb(contact::friction_disc{}, s.K, s.data, s.F, o);
}

auto agree(scene const& s) {
  double const tolerance = 1e-9;
  auto const iterated = solve(s, {.tolerance = tolerance, .route = solution_route::iterate});
  auto const factored = solve(s, {.tolerance = 1e-12, .route = solution_route::factor});
  CAPTURE(iterated.reason);
  REQUIRE(iterated.converged());
  CHECK(iterated.choice.route == solution_route::iterate);
  CHECK(iterated.method == "slip bounds and Newton");
  std::ostringstream out;
  out << iterated;
  CHECK(out.str().find(" of slip bounds and Newton\n") != std::string::npos);
  CHECK(iterated.work.factorizations == 0);
  CHECK(iterated.error.relative() <= tolerance);
  CHECK(oracle::energy_error(s.K, iterated.u, factored.u) <= tolerance);
  CHECK((iterated.λ - factored.λ).norm() <= 100 * tolerance * factored.λ.norm());
  auto law = s.data;
  law.g = s.F.cwiseProduct(iterated.λ.head(s.F.size()));
  CHECK(contact::check_optimality(s.K, law, iterated.u, iterated.λ).residual() <= 1e-7);
  return iterated;
}

TEST_CASE("bricks with Coulomb friction: the solution by forces, K never factored") {
  for (auto const load : fem::brick_loads) {
    for (double const F : {0.1, 0.3, 1.0}) {
      for (int const k : {2, test::effort(8, 4)}) {
        CAPTURE(k);
        CAPTURE(F);
        auto const r = agree(brick(k, load, F));
        CHECK(r.steps <= 14);
        CHECK(r.work.inner_iterations <= 50);
      }
    }
  }
}

TEST_CASE("much friction under the lift, where slip bounds alone hardly contract") {
  for (double const F : {2.0, 5.0}) {
    CAPTURE(F);
    auto const r = agree(brick(test::effort(8, 4), fem::brick_load::lift, F));
    CHECK(r.work.inner_iterations <= 110);  // 63 and 192 by slip bounds alone
  }
}

TEST_CASE("Newton's steps for Coulomb's law are superlinear from the first slip bounds on") {
  namespace detail = contact::detail;
  for (scene const& s : {brick(4, fem::brick_load::lift, 0.5), brick(4, fem::brick_load::pull, 0.3),
                         scene_of(fem::make_two_plates(6), 0.3)}) {
    VectorXd const exact = solve(s, {.tolerance = 1e-12, .route = solution_route::factor}).u;
    detail::primal_run<double> run(s.K, s.data, s.layout, {}, 100);
    auto const& state = run.state();
    while (state.status == slant::status::running) run.step(0.05 * run.size());
    VectorXd λ(s.F.size());
    run.pressures(λ);
    run.set_slip_bounds(s.F.cwiseProduct(λ));
    while (state.status == slant::status::running) run.step(0.01 * run.size());
    detail::alart_curnier_steps<double> steps(run.problem(), run.qp(), run.levels(), s.F,
                                              state.step_length);
    auto const error_after = [&](int count, double goal) {
      VectorXd x = state.x;
      slant::work spent;
      (void)steps.run(x, state.r, state.unit, true, goal, count, spent);
      return oracle::energy_error(s.K, run.problem().displacement(x), exact);
    };
    CHECK(error_after(0, 0) >= 1e-3);
    CHECK(error_after(2, 0) <= 1e-3);
    CHECK(error_after(4, 0) <= 1e-9);
    // As near as asked for, and hardly nearer.
    slant::index const before = steps.steps();
    double const reached = error_after(12, 1e-5 * run.size());
    CHECK(reached <= 1e-5);
    CHECK(steps.steps() - before <= 4);
  }
}

TEST_CASE("two bodies, meshes that match and such that do not") {
  agree(scene_of(fem::make_two_bricks(4), 0.3));
  agree(scene_of(test::facing_bricks(4, 5), 0.3));
  agree(scene_of(fem::make_two_plates(8), 0.3));
}

TEST_CASE(
    "bodies that contact and friction hold: by Tresca's problem with the bounds that were found") {
  for (auto const& end : {Vector3d(0, 0, 0), {-0.25, 0, 0}, {-3, 0, 0}}) {
    for (double const gap : {0.0, 1e-5}) {
      CAPTURE(end[0]);
      CAPTURE(gap);
      test::loose_brick const loose(0.3, end, 0);
      scene s{loose.K, loose.data, VectorXd::Constant(loose.data.d.size(), 0.3),
              contact::interleaved_layout(loose.mesh.nodes)};
      s.data.d.setConstant(gap);
      auto const r = solve(s, {.tolerance = 1e-9});
      CAPTURE(r.reason);
      if (end[0] == -3) {  // slides away
        CHECK(r.status == slant::status::stalled);
        CHECK(r.reason.find("contact hardly holds bodies without supports") != std::string::npos);
        continue;
      }
      CHECK(r.converged());
      CHECK(r.choice.route == solution_route::iterate);
      auto law = s.data;
      law.g = s.F.cwiseProduct(r.λ.head(s.F.size()).cwiseMax(0));
      CHECK(contact::check_optimality(s.K, law, r.u, r.λ).residual() <= 1e-7);
      auto const tresca =
          contact::solve(s.K, law, {.tolerance = 1e-11, .route = solution_route::factor});
      CHECK(oracle::energy_error(s.K, r.u, tresca.u) <= 1e-9);
    }
  }
}

TEST_CASE("no friction, nodes without, infinite gaps, units, turned rows, no coordinates") {
  scene const s = brick(3, fem::brick_load::lift, 0.3);
  scene other = s;
  other.F.setZero();
  auto const r = agree(other);
  auto const frictionless = contact::solve(
      contact::frictionless{}, s.K,
      contact::data<double>{s.data.N, sparse(0, s.K.rows()), s.data.f, s.data.d, VectorXd(0)},
      {.tolerance = 1e-11});
  CHECK((r.u - frictionless.u).norm() <= 1e-7 * frictionless.u.norm());
  other = s;
  for (Index i = 0; i < s.F.size(); i += 2) other.F[i] = 0;
  for (Index i = 1; i < s.F.size(); i += 3)
    other.data.d[i] = std::numeric_limits<double>::infinity();
  agree(other);
  other = s;
  other.layout = {};
  VectorXd const u = agree(other).u;
  other = s;
  other.K *= 0x1p200;
  other.data.f *= 0x1p-200;
  other.data.d *= 0x1p-400;
  auto const scaled = solve(other, {.route = solution_route::iterate});
  CHECK(scaled.converged());
  CHECK((scaled.u * 0x1p400 - u).norm() <= 1e-7 * u.norm());
  // Rows of N and T in any direction, of other lengths: the same contact of a turned body.
  sparse const turn = test::rotation(s.K.rows()), back = turn.transpose();
  other = s;
  other.K = turn * s.K * back;
  other.K = sparse(0.5 * (other.K + sparse(other.K.transpose())));
  other.data.f = turn * s.data.f;
  other.data.N = 2 * s.data.N * back;
  other.data.T = 2 * s.data.T * back;
  other.data.d = 2 * s.data.d;
  auto const turned = agree(other);
  CHECK((back * turned.u - u).norm() <= 1e-6 * u.norm());
}

TEST_CASE("the choice, and what ends without a solution") {
  scene const s = brick(2, fem::brick_load::lift, 0.3);
  contact::route_costs costs;
  costs.cycle = 1;
  CHECK(solve(s, {.costs = costs}).choice.route == solution_route::factor);
  costs = {.ordering = 1};
  CHECK(solve(s, {.costs = costs}).choice.route == solution_route::iterate);
  // One problem of Tresca's does not do where friction locks.
  scene const locked = brick(3, fem::brick_load::lift, 3);
  auto const few = solve(locked, {.outer_steps = 1, .route = solution_route::iterate});
  CHECK(few.status == slant::status::iteration_limit);
  CHECK(few.reason.find("no more problems of Tresca's were allowed") != std::string::npos);
  options const once{.tolerance = 0, .outer_steps = 1, .route = solution_route::iterate};
  CHECK(solve(s, once).status == slant::status::iteration_limit);
  auto const any = std::numeric_limits<Index>::max();
  CHECK(solve(s, {.outer_steps = any, .route = solution_route::iterate}).converged());
  auto const after = solve(locked, {.outer_steps = 1, .costs = costs});
  CHECK(after.converged());
  CHECK(after.choice.route == solution_route::factor);
  CHECK(after.choice.reason.find("factored after all") != std::string::npos);
  CHECK(after.work.factorizations == 1);
  CHECK(after.work.inner_iterations > few.work.inner_iterations);  // that of both
  auto const exact = solve(s, {.tolerance = 0, .route = solution_route::iterate});
  CHECK(exact.status == slant::status::stalled);
  CHECK(exact.error.relative() <= 1e-11);
  CHECK(SLANT_COMPLAINT(
            solve(s, {.method = contact::coulomb_method::newton, .route = solution_route::iterate}))
            .find("the method works on forces") != std::string::npos);
  if (!test::is_optimised) return;
  // Both ways are open whichever came first, and whatever seemed to float.
  auto const slender = [](int k, double thickness, fem::brick_load load, double F) {
    return scene_of(fem::make_steel_brick({.k = k, .load = load, .size = {30, thickness, 0.9}}), F);
  };
  options short_of{.tolerance = 1e-6, .newton_steps = 1, .costs = {.cycle = 1}};
  scene const thin = slender(3, 0.04, fem::brick_load::pull, 0.3);
  short_of.outer_steps = 30;
  auto const iterated = solve(thin, short_of);
  CAPTURE(iterated.choice.reason);
  CHECK(iterated.converged());
  CHECK(iterated.choice.route == solution_route::iterate);
  CHECK(iterated.choice.reason.find("iterated after all: ") != std::string::npos);
  scene const thinner = slender(2, 0.01, fem::brick_load::pull, 0.01);
  auto const factored = solve(thinner, {.tolerance = 1e-4, .outer_steps = 1});
  CAPTURE(factored.choice.reason);
  CHECK(factored.converged());
  CHECK(factored.choice.reason.find("iterated: factors need supports of every body; factored "
                                    "after all: ") == 0);
  CHECK(factored.work.factorizations == 1);
  // Of two that have not converged the nearer.
  auto const nearer = solve(thinner, {.tolerance = 1e-12, .outer_steps = 1});
  CHECK(!nearer.converged());
  CHECK(nearer.error.relative() <= 1e-5);
  CHECK(nearer.choice.route == solution_route::factor);
}

}  // namespace iterated_coulomb_test
