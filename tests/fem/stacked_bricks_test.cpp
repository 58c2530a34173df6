// SPDX-License-Identifier: MIT
#include <fem/plate_chain.hpp>
#include <fem/stacked_bricks.hpp>
#include <support/testing.hpp>

namespace stacked_bricks_test {

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
  for (Eigen::Index i = 0; i < rows; ++i) {
    CHECK((scene.B * to_the_wall)[i] == (scene.axes[static_cast<std::size_t>(i)] == 0 ? 1 : 0));
  }
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

}  // namespace stacked_bricks_test
