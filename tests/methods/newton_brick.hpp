// SPDX-License-Identifier: MIT
//
// The symmetric Newton method on the steel brick against the independent dense reference, at one
// mesh and load.
#pragma once

#include <slant/contact/dual.hpp>
#include <slant/contact/optimality.hpp>
#include <slant/contact/preconditioners.hpp>
#include <slant/factorizations/factorize.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/methods/symmetric_newton.hpp>

#include <doctest/doctest.h>

#include <contact/scenes.hpp>

namespace test {

/// Products spent when the relative energy error of λ has fallen to 1e-8: without a preconditioner
/// at most `most`, with the lumped one at most `preconditioned`.
inline void check_newton_brick(int k, fem::brick_load load, slant::index most,
                               slant::index preconditioned) {
  CAPTURE(k);
  CAPTURE(fem::name_of(load));
  auto const scene = fem::make_steel_brick({.k = k, .load = load});
  auto const data = test::contact_data(scene);
  auto const reference = test::reference(scene.K, data);
  slant::contact::dual const dual(slant::contact::friction_disc{}, slant::factorize(scene.K), data);
  auto const qp = dual.qp();
  auto const A = dual.a();
  Eigen::VectorXd const exact = reference.multipliers();
  auto const energy = [&](Eigen::VectorXd const& λ) { return energy_norm(A, λ); };
  double const size = energy(exact);
  auto const check = [&](auto const& method, slant::index limit) {
    slant::index products = -1;
    auto const watch = [&](auto const& s) {
      if (products < 0 && energy(s.x - exact) <= 1e-8 * size)
        products = s.work.operator_applications;
    };
    auto const r = slant::solve(method, dual.zero(),
                                slant::reduced_gradient_below(1e-12) || slant::at_most(60), watch);
    REQUIRE(r.converged());
    CHECK(products > 0);
    CHECK(products <= limit);
    CHECK(r.state.descent.count() == 0);
    auto const u = dual.displacement(r.x());
    // Relative to other sizes than the method's 1e-12, and with the rounding of a solve with K in
    // it.
    CHECK(slant::contact::check_optimality(scene.K, data, u, r.x()).residual() <= 1e-10);
  };
  check(slant::symmetric_newton{qp}, most);
  check(slant::symmetric_newton{qp,
                                slant::contact::lumped_preconditioner(scene.K, dual.constraints())},
        preconditioned);
}

}  // namespace test
