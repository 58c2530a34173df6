// SPDX-License-Identifier: MIT
#include <fem/steel_brick.hpp>
#include <oracle/dense_contact_reference.hpp>
#include <support/testing.hpp>

namespace dense_contact_reference_test {

TEST_CASE("the reference of the finer bricks is optimal by duality") {
  for (int const k : {4, 6, 8})
    for (fem::brick_load const load : fem::brick_loads) {
      CAPTURE(k);
      CAPTURE(fem::name_of(load));
      auto const scene = fem::make_steel_brick({.k = k, .load = load});
      auto const reference =
          oracle::solve_contact({scene.K, scene.N, scene.T, scene.f, scene.d, scene.g});
      CHECK(reference.violations.largest() < 1e-14);
      CHECK(reference.proof.infeasibility < 1e-18);
      CHECK(reference.energy_error < 1e-9);
    }
}

}  // namespace dense_contact_reference_test
