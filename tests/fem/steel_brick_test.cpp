// SPDX-License-Identifier: MIT
#include <fem/elasticity_3d.hpp>
#include <support/testing.hpp>

namespace steel_brick_test {

TEST_CASE("N and T pick the displacements of the contact nodes") {
  auto const scene = fem::make_steel_brick({.k = 2});
  VectorXd const u = VectorXd::LinSpaced(scene.K.rows(), -1, 1);
  auto const nodal = scene.displacement(u);
  VectorXd const normal = scene.N * u;
  VectorXd const tangential = scene.T * u;
  for (Eigen::Index i = 0; i < scene.contact_count(); ++i) {
    int const node = scene.contact_nodes[static_cast<std::size_t>(i)];
    CHECK(scene.mesh.nodes(2, node) == 0);
    CHECK(scene.mesh.nodes(0, node) > 0);
    CHECK(normal[i] == -nodal(2, node));  // (0, 0, −1) points out of the brick
    CHECK(tangential[2 * i] == nodal(0, node));
    CHECK(tangential[2 * i + 1] == nodal(1, node));
    CHECK(scene.contact_patches[static_cast<std::size_t>(i)].centre ==
          scene.mesh.nodes.col(node).head<2>());
  }
  CHECK(scene.contact_side.lower == Vector2d(0, 0));
  CHECK(scene.contact_side.upper == Vector2d(3, 1));
  CHECK(scene.d.isZero(0));
}

TEST_CASE("slip bounds add up to g times the area of the contact nodes") {
  for (int const k : {1, 3}) {
    double const area = 3 - 0.5 / k;  // the fixed nodes own half a cell
    auto const press = fem::make_steel_brick({.k = k, .load = fem::brick_load::press});
    auto const lift = fem::make_steel_brick({.k = k, .load = fem::brick_load::lift});
    CHECK(press.contact_weights.sum() == doctest::Approx(area).epsilon(1e-14));
    CHECK(press.g.sum() == doctest::Approx(0.3 * area).epsilon(1e-14));
    CHECK(lift.g.sum() == doctest::Approx(0.6 * area).epsilon(1e-14));
  }
}

TEST_CASE("the three loads") {
  auto const total = [](fem::brick_load load) {
    auto const scene = fem::make_steel_brick({.k = 2, .load = load});
    return Vector3d(scene.displacement(scene.f).rowwise().sum());
  };
  double const top = 3 - 0.25;  // without the share of the fixed nodes
  CHECK((total(fem::brick_load::press) - Vector3d(0, 0, -top)).norm() < 1e-13);
  CHECK((total(fem::brick_load::pull) - Vector3d(0.5, 0, 0.3 - top)).norm() < 1e-13);
  CHECK((total(fem::brick_load::lift) - Vector3d(0.3, 0.2, 1.2 - top)).norm() < 1e-13);
  for (fem::brick_load const load : fem::brick_loads)
    CHECK(fem::brick_load_named(fem::name_of(load)) == load);
  CHECK_FALSE(fem::brick_load_named("twist").has_value());
}

TEST_CASE("a contact scene in the plane") {
  fem::box_on_foundation<2> plate{.mesh = fem::make_box_mesh<2>({6, 2}, {3, 1}),
                                  .material = fem::lame_plane_stress(2e5, 0.3),
                                  .fixed = {0, false},
                                  .contact = {1, false},
                                  .slip_bound = 0.5,
                                  .gap = 0.01};
  auto const scene = fem::make_contact_scene(plate);
  CHECK(scene.contact_count() == 6);
  CHECK(scene.T.rows() == 6);
  CHECK(scene.g.sum() == doctest::Approx(0.5 * (3 - 0.25)));
  CHECK(scene.d == VectorXd::Constant(6, 0.01));
  VectorXd const down = VectorXd::LinSpaced(scene.K.rows(), 0, 1);
  CHECK((scene.N * down)[0] == -scene.displacement(down)(1, scene.contact_nodes[0]));
}

TEST_CASE("impossible scenes are refused by name") {
  CHECK_THROWS_AS((void)fem::make_steel_brick({.k = -1}), std::invalid_argument);
  CHECK_THROWS_AS((void)fem::make_steel_brick({.nu = 0.5}), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)fem::make_steel_brick({.load_factor = 0}),
                       "load_factor: got 0, expected a positive finite number",
                       std::invalid_argument);
}

}  // namespace steel_brick_test
