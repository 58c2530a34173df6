// SPDX-License-Identifier: MIT
#include <slant/contact/dual.hpp>
#include <slant/contact/optimality.hpp>
#include <slant/factorizations/factorize.hpp>
#include <slant/iteration/solve_then.hpp>
#include <slant/methods/interior_point.hpp>
#include <slant/methods/symmetric_newton.hpp>

#include <doctest/doctest.h>

#include <contact/scenes.hpp>
#include <support/effort.hpp>

namespace interior_point_brick_test {

using Eigen::VectorXd;

void check_brick(int k, fem::brick_load load) {
  CAPTURE(k);
  CAPTURE(fem::name_of(load));
  auto const scene = fem::make_steel_brick({.k = k, .load = load});
  auto const data = test::contact_data(scene);
  auto const reference = test::reference(scene.K, data);
  slant::contact::dual const dual(slant::contact::friction_disc{}, slant::factorize(scene.K), data);
  auto const qp = dual.qp();
  VectorXd const exact = reference.multipliers();
  auto const energy = [&](VectorXd const& λ) { return test::energy_norm(qp.a(), λ); };
  double const size = energy(exact);
  slant::index steps = -1, products = -1;
  auto const watch = [&](auto const& s) {
    if (steps >= 0 || energy(s.x - exact) > 1e-6 * size) return;
    steps = s.iteration;
    products = s.work.operator_applications + s.work.setup_applications;
  };
  slant::interior_point const interior{qp};
  auto const r = slant::solve(interior, dual.zero(),
                              slant::reduced_gradient_below(1e-9) || slant::at_most(60), watch);
  REQUIRE(r.converged());
  CHECK(steps >= 0);
  CHECK(steps <= 30);
  CHECK(products <= 300);
  auto const u = dual.displacement(r.x());
  CHECK(slant::contact::check_optimality(scene.K, data, u, r.x()).residual() <= 1e-7);
  // The last digits are those of the symmetric Newton method.
  auto const both =
      slant::solve_then(interior, slant::reduced_gradient_below(1e-2) || slant::at_most(30),
                        slant::symmetric_newton{qp}, dual.zero(),
                        slant::reduced_gradient_below(1e-12) || slant::at_most(60));
  REQUIRE(both.converged());
  CHECK(both.first.converged());
  CHECK(energy(both.x() - exact) <= 1e-10 * size);
}

TEST_CASE("the brick: energy error 1e-6 in 30 steps and 300 products, then the last digits") {
  for (auto const load : fem::brick_loads) {
    for (int k = 2; k <= test::effort(4, 2); ++k) check_brick(k, load);
  }
}

}  // namespace interior_point_brick_test
