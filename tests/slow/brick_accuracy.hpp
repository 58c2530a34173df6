// SPDX-License-Identifier: MIT
//
// KPRGP on the steel brick against the independent dense reference, at one mesh and load.
#pragma once

#include <slant/contact/dual.hpp>
#include <slant/contact/optimality.hpp>
#include <slant/factorizations/factorize.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/methods/kprgp.hpp>

#include <doctest/doctest.h>

#include <contact/scenes.hpp>

namespace test {

/// Energy error and residual at most 1e-6, within 25000 products.
inline void check_brick_accuracy(int k, fem::brick_load load) {
  CAPTURE(k);
  CAPTURE(fem::name_of(load));
  auto const scene = fem::make_steel_brick({.k = k, .load = load});
  auto const data = test::contact_data(scene);
  auto const reference = test::reference(scene.K, data);
  slant::contact::dual const dual(slant::contact::friction_disc{}, slant::factorize(scene.K), data);
  auto const qp = dual.qp();
  auto const r = slant::solve(slant::kprgp{qp}, dual.zero(),
                              slant::reduced_gradient_below(1e-9) || slant::at_most(50000));
  REQUIRE(r.converged());
  auto const u = dual.displacement(r.x());
  CHECK(oracle::energy_error(scene.K, u, reference.u) <= 1e-6);
  CHECK(slant::contact::check_optimality(scene.K, data, u, r.x()).residual() <= 1e-6);
  CHECK(r.state.work.operator_applications <= 25000);
}

}  // namespace test
