// SPDX-License-Identifier: MIT
//
// A method on the steel brick against the independent dense reference, at one mesh and load.
#pragma once

#include <slant/contact/dual.hpp>
#include <slant/contact/optimality.hpp>
#include <slant/contact/preconditioners.hpp>
#include <slant/slant.hpp>

#include <contact/scenes.hpp>
#include <support/testing.hpp>

namespace test {

/// What a run has to reach: a relative energy error of λ of at most `error` within so many products
/// with A, those of the setup included, and steps; at its end a KKT residual of at most `residual`.
struct brick_demand {
  double error;
  slant::index products;
  double residual;
  slant::index steps = 100000;
};

/// run(scene, dual, watch) is a report; watch observes each state.
template <class Run>
void check_brick(int k, fem::brick_load load, brick_demand const& demand, Run const& run) {
  CAPTURE(k);
  CAPTURE(fem::name_of(load));
  auto const scene = fem::make_steel_brick({.k = k, .load = load});
  auto const data = test::contact_data(scene);
  slant::contact::dual const dual(slant::contact::friction_disc{}, slant::factorize(scene.K), data);
  auto const A = dual.a();
  VectorXd const exact = test::reference(scene.K, data).multipliers();
  auto const error = [&](VectorXd const& λ) {
    return energy_norm(A, VectorXd(λ - exact)) / energy_norm(A, exact);
  };
  slant::index steps = -1, products = -1;
  auto const watch = [&](auto const& s) {
    if (steps >= 0 || error(s.x) > demand.error) return;
    steps = s.iteration;
    products = s.work.operator_applications + s.work.setup_applications;
  };
  auto const r = run(scene, dual, watch);
  REQUIRE(r.converged());
  CHECK(steps >= 0);
  CHECK(steps <= demand.steps);
  CHECK(products <= demand.products);
  CHECK(error(r.x()) <= demand.error);
  // Relative to other sizes than what the method watches, and with the rounding of a solve with K.
  auto const u = dual.displacement(r.x());
  CHECK(slant::contact::check_optimality(scene.K, data, u, r.x()).residual() <= demand.residual);
}

/// The symmetric Newton method, in `most` products without a preconditioner and in `preconditioned`
/// with the lumped one.
inline void check_newton_brick(int k, fem::brick_load load, slant::index most,
                               slant::index preconditioned) {
  auto const finish = [](auto const& method, auto const& dual, auto const& watch) {
    auto const r = slant::solve(method, dual.zero(),
                                slant::reduced_gradient_below(1e-12) || slant::at_most(60), watch);
    CHECK(r.state.descent.count() == 0);
    return r;
  };
  check_brick(k, load, {1e-8, most, 1e-10}, [&](auto const&, auto const& dual, auto const& watch) {
    auto const qp = dual.qp();
    return finish(slant::symmetric_newton{qp}, dual, watch);
  });
  check_brick(k, load, {1e-8, preconditioned, 1e-10},
              [&](auto const& scene, auto const& dual, auto const& watch) {
                auto const qp = dual.qp();
                auto const M = slant::contact::lumped_preconditioner(scene.K, dual.constraints());
                return finish(slant::symmetric_newton{qp, M}, dual, watch);
              });
}

}  // namespace test
