// SPDX-License-Identifier: MIT
#include <slant/io/matrix_market.hpp>

#include <fem/elasticity_3d.hpp>
#include <fem/plate_chain.hpp>
#include <fem/stacked_bricks.hpp>
#include <fem/steel_brick.hpp>
#include <fem/write_folder.hpp>
#include <io/io_support.hpp>
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

bool same(Eigen::SparseMatrix<double> const& a, Eigen::SparseMatrix<double> const& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() && (a - b).norm() == 0;
}

TEST_CASE("a scene comes back from its folder bit for bit") {
  io_test::temporary_folder const temporary;
  auto const folder = temporary / "scenes/brick";  // neither exists yet
  auto const scene = fem::make_steel_brick({.k = 1, .load = fem::brick_load::lift});
  fem::write_folder(scene, folder);
  CHECK(same(slant::read_matrix_market(folder / "K.mtx"), scene.K));
  CHECK(same(slant::read_matrix_market(folder / "N.mtx"), scene.N));
  CHECK(same(slant::read_matrix_market(folder / "T.mtx"), scene.T));
  CHECK((slant::read_text_vector(folder / "f.txt") == scene.f));
  CHECK((slant::read_text_vector(folder / "d.txt") == scene.d));
  CHECK((slant::read_text_vector(folder / "g.txt") == scene.g));
}

/// The same displacement of all nodes, or a rotation about an axis through the origin.
VectorXd rigid_motion(fem::stack_scene const& scene, int which) {
  VectorXd motion(scene.K.rows());
  for (Eigen::Index node = 0; node < scene.mesh.node_count(); ++node) {
    Vector3d const axis = Vector3d::Unit(which % 3);
    Vector3d const x = scene.mesh.nodes.col(node);
    motion.segment<3>(3 * node) = which < 3 ? axis : Vector3d(axis.cross(x));
  }
  return motion;
}

TEST_CASE("a stack floats: six rigid motions of each brick") {
  auto const scene = fem::make_stack({.bricks = 2, .cells = {3, 2, 2}, .gap = 0.1});
  Eigen::Index const half = scene.K.rows() / 2;
  CHECK(half == 3 * 4 * 3 * 3);
  for (int which = 0; which < 6; ++which) {
    VectorXd motion = rigid_motion(scene, which);
    motion.head(half).setZero();
    CHECK((scene.K * motion).norm() <= 1e-12 * scene.K.norm() * motion.norm());
  }
  CHECK(Eigen::SparseMatrix<double>(scene.K.transpose()).isApprox(scene.K, 0));
  CHECK(scene.K.nonZeros() > 0);
}

TEST_CASE("constraints: floor, neighbours and walls; loads add up to the pressures") {
  auto const scene = fem::make_stack({.bricks = 2, .cells = {3, 2, 2}, .gap = 0.1});
  Eigen::Index const rows = scene.c.size();
  CHECK(rows == 2 * (4 * 3 + 3 * 3 + 4 * 3));
  CHECK(scene.nodes.size() == std::size_t(rows));
  // Down by the gap: the lower brick meets the floor, the upper one keeps its distance; towards the
  // walls nothing can move.
  VectorXd const down = -0.1 * rigid_motion(scene, 2);
  VectorXd const motion = scene.B * down;
  for (Eigen::Index i = 0; i < rows; ++i) {
    auto const at = static_cast<std::size_t>(i);
    bool const on_floor = scene.axes[at] == 2 && scene.mesh.nodes(2, scene.nodes[at]) < 0.15;
    CHECK(motion[i] == doctest::Approx(on_floor ? 0.1 : 0));
    CHECK(scene.c[i] == (scene.axes[at] == 2 ? 0.1 : 0));
  }
  VectorXd const to_the_wall = -rigid_motion(scene, 0);
  for (Eigen::Index i = 0; i < rows; ++i)
    CHECK((scene.B * to_the_wall)[i] == (scene.axes[static_cast<std::size_t>(i)] == 0 ? 1 : 0));
  CHECK(scene.f.dot(rigid_motion(scene, 0)) == doctest::Approx(-0.3 * 2));
  CHECK(scene.f.dot(rigid_motion(scene, 1)) == doctest::Approx(-0.3 * 4));
  // ∫ p over (0, 2) × (0, 1), p = 1.5 … −0.4, and its moment about the y axis less that of the
  // walls.
  CHECK(scene.f.dot(rigid_motion(scene, 2)) == doctest::Approx(-1.1));
  CHECK_THROWS_AS((void)fem::make_stack({.bricks = 0}), std::invalid_argument);
  CHECK_THROWS_AS((void)fem::make_stack({.gap = -1}), std::invalid_argument);
  CHECK_THROWS_AS((void)fem::make_stack({.E = {}}), std::invalid_argument);
}

TEST_CASE("a chain: the gaps of those that cannot touch are infinite") {
  auto const scene = fem::make_plate_chain({.plates = 5, .touching = 3, .k = 4, .gap = 0.25});
  CHECK(scene.K.rows() == 5 * 2 * 5 * 4);
  CHECK(scene.c.size() == 4 * 4);
  CHECK(scene.c.head(8) == VectorXd::Constant(8, 0.25));
  CHECK((scene.c.tail(8).array() == std::numeric_limits<double>::infinity()).all());
  // All plates to the right by the same length: no distance changes.
  VectorXd right = VectorXd::Zero(scene.K.rows());
  for (Eigen::Index i = 0; i < right.size(); i += 2) right[i] = 1;
  CHECK((scene.B * right).norm() == 0);
  CHECK(scene.f.dot(right) == doctest::Approx(2 - 2.0 / 8));  // less what the fixed corner takes
  CHECK_THROWS_AS((void)fem::make_plate_chain({.plates = 2, .touching = 3}), std::invalid_argument);
}

}  // namespace steel_brick_test
