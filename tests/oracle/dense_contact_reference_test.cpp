// SPDX-License-Identifier: MIT
#include <fem/steel_brick.hpp>
#include <oracle/dense_contact_reference.hpp>
#include <support/testing.hpp>

namespace dense_contact_reference_test {

auto solve_brick(int k, fem::brick_load load) {
  auto scene = fem::make_steel_brick({.k = k, .load = load});
  auto reference = oracle::solve_contact({scene.K, scene.N, scene.T, scene.f, scene.d, scene.g});
  return std::pair(std::move(scene), std::move(reference));
}

TEST_CASE("the reference of the brick satisfies the contact conditions and is optimal by duality") {
  auto const check = [](int k, fem::brick_load load) {
    CAPTURE(k);
    CAPTURE(fem::name_of(load));
    auto const [scene, reference] = solve_brick(k, load);
    CHECK(reference.violations.largest() < 1e-15);
    CHECK(reference.proof.infeasibility < 1e-18);
    CHECK(reference.energy_error < 1e-9);
    CHECK(reference.report.residual < 1e-17);
  };
  for (int const k : {1, 2})
    for (fem::brick_load const load : fem::brick_loads) check(k, load);
  check(test::effort(3, 1), fem::brick_load::lift);
}

TEST_CASE("a perturbed displacement violates the conditions") {
  auto const [scene, reference] = solve_brick(1, fem::brick_load::lift);
  oracle::contact_data const data{scene.K, scene.N, scene.T, scene.f, scene.d, scene.g};
  oracle::real_vector const u = reference.u.cast<oracle::real>();
  oracle::real_vector const λ = reference.report.x;
  CHECK(oracle::check_contact(data, u, λ).largest() < 1e-14);
  oracle::real_vector moved = u;
  moved[0] += 1e-3L * u.cwiseAbs().maxCoeff();
  CHECK(oracle::check_contact(data, moved, λ).equilibrium > 1e-6);
  oracle::real_vector adhesive = λ;
  adhesive[0] = -1e-3L * λ.cwiseAbs().maxCoeff();
  CHECK(oracle::check_contact(data, u, adhesive).adhesion == doctest::Approx(1e-3));
  CHECK(oracle::energy_error(scene.K, 1.001 * reference.u, reference.u) == doctest::Approx(1e-3));
}

}  // namespace dense_contact_reference_test
