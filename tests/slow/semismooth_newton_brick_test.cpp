// SPDX-License-Identifier: MIT
//
// The brick by the generic method alone: natural residual, CG chosen by the laws, line search.
#include <slant/contact/dual.hpp>
#include <slant/factorizations/factorize.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/newton/semismooth_newton.hpp>
#include <slant/operators/declare.hpp>
#include <slant/slanting/natural_residual.hpp>

#include <doctest/doctest.h>

#include <contact/scenes.hpp>
#include <support/effort.hpp>

namespace semismooth_newton_brick_test {

using Eigen::VectorXd;

/// 1/mean(diag A), from every seventh unit vector: normals and tangents alike.
template <class A>
double natural_step(A const& a) {
  VectorXd unit(a.rows()), image(a.rows());
  double sum = 0, count = 0;
  for (Eigen::Index i = 0; i < a.rows(); i += 7, ++count) {
    unit.setZero();
    unit[i] = 1;
    slant::apply(a, unit, image);
    sum += image[i];
  }
  return count / sum;
}

void check_brick(int k, fem::brick_load load) {
  CAPTURE(k);
  CAPTURE(fem::name_of(load));
  auto const scene = fem::make_steel_brick({.k = k, .load = load});
  auto const data = test::contact_data(scene);
  auto const reference = test::reference(scene.K, data);
  slant::contact::dual const dual(slant::contact::friction_disc{}, slant::factorize(scene.K), data);
  auto const qp = dual.qp();
  // Each contact node has unknowns of its own, so the rows of B are independent.
  auto const A = slant::declare<slant::self_adjoint, slant::positive_definite>(qp.a());
  auto const F = slant::natural_residual(A, qp.b(), qp.set(), natural_step(A));
  slant::semismooth_newton const method{F};
  static_assert(std::is_same_v<decltype(method)::solver_for<VectorXd>, slant::symmetrized_cg>);
  auto const r =
      slant::solve(method, dual.zero(), slant::residual_below(1e-10) || slant::at_most(50));
  REQUIRE(r.converged());
  CHECK(oracle::energy_error(scene.K, dual.displacement(r.x()), reference.u) <= 1e-8);
  CHECK(r.state.work.operator_applications <= 250);
}

TEST_CASE("energy error at most 1e-8 within 250 products") {
  for (auto const load : fem::brick_loads) check_brick(test::effort(4, 2), load);
}

}  // namespace semismooth_newton_brick_test
