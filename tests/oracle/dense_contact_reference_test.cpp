// SPDX-License-Identifier: MIT
#include <slant/contact/optimality.hpp>

#include <fem/steel_brick.hpp>
#include <oracle/dense_contact_reference.hpp>
#include <support/testing.hpp>

namespace dense_contact_reference_test {

TEST_CASE(
    "the reference of the brick is optimal by duality, and satisfies the conditions on K, N, T") {
  auto const check = [](int k, fem::brick_load load) {
    CAPTURE(k);
    CAPTURE(fem::name_of(load));
    auto const scene = fem::make_steel_brick({.k = k, .load = load});
    auto const reference =
        oracle::solve_contact({scene.K, scene.N, scene.T, scene.f, scene.d, scene.g});
    slant::contact::data<double> const data{scene.N, scene.T, scene.f, scene.d, scene.g};
    CHECK(slant::contact::check_optimality(scene.K, data, reference.u, reference.multipliers())
              .residual() < 1e-10);
    CHECK(reference.proof.infeasibility < 1e-18);
    CHECK(reference.energy_error < 1e-9);
    CHECK(reference.report.residual < 1e-17);
  };
  for (int const k : {1, 2})
    for (fem::brick_load const load : fem::brick_loads) check(k, load);
  check(test::effort(3, 1), fem::brick_load::lift);
}

}  // namespace dense_contact_reference_test
