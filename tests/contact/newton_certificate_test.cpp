// SPDX-License-Identifier: MIT
#include <slant/contact/certificate.hpp>

#include <slant/contact/dual.hpp>
#include <slant/contact/preconditioners.hpp>
#include <slant/contact/solve.hpp>
#include <slant/factorizations/factorize.hpp>
#include <slant/methods/interior_point.hpp>
#include <support/testing.hpp>
#include "scenes.hpp"

namespace newton_certificate_test {

namespace contact = slant::contact;

TEST_CASE("interior points are judged by what lies on the face: 200 products to an error of 1e-8") {
  for (int const k : {4, 5, 7}) {
    if (k > test::effort(7, 4)) continue;
    for (auto const load : fem::brick_loads) {
      CAPTURE(k);
      CAPTURE(fem::name_of(load));
      auto const scene = fem::make_steel_brick({.k = k, .load = load});
      auto const data = test::contact_data(scene);
      auto const factor = slant::factorize(scene.K);
      contact::dual const dual(contact::friction_disc{}, factor, data);
      auto const qp = dual.qp();
      auto const M = contact::lumped_preconditioner(scene.K, dual.constraints());
      contact::certificate<double> certificate(scene.K, data);
      contact::newton_certificate by_newton(qp, M, certificate);
      VectorXd λ, u;
      double without = 0;
      auto const error_of = [&](VectorXd const& x) {
        λ = x;
        u = dual.displacement(λ);
        auto const e = certificate(dual.set(), λ, u, 1e-8, contact::solver(factor));
        without = e.relative();
        return by_newton(λ);
      };
      auto const run = slant::solve(
          slant::interior_point{qp, M, {.inner_share = 0.3}}, VectorXd::Zero(qp.size()).eval(),
          slant::energy_error_below(1e-8, error_of) || slant::at_most(60));
      REQUIRE(run.converged());
      CHECK(run.state.work.operator_applications <= 200);
      // The gap alone, whose root goes with √ϑ where the error goes with ϑ, asks for many more.
      CHECK(without > 1e-7);
      auto const exact =
          contact::solve(contact::friction_disc{}, scene.K, data, {.tolerance = 1e-12});
      double const error = oracle::energy_error(scene.K, u, exact.u);
      CHECK(error <= 1e-8);
      CHECK(error_of(run.x()).relative() >= error);
    }
  }
}

}  // namespace newton_certificate_test
