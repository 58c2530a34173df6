// SPDX-License-Identifier: MIT
#include <fem/decomposition.hpp>
#include <fem/steel_brick.hpp>
#include <support/testing.hpp>

namespace decomposition_test {

auto const steel = fem::lame(2.119e5, 0.277);

TEST_CASE("what is glued is the body itself") {
  auto const scene = fem::make_steel_brick({.k = 2, .load = fem::brick_load::pull});
  auto const mesh = fem::make_brick_mesh(2);
  auto const parts = fem::decompose<3>(scene, steel, fem::box_partition<3>(mesh, {3, 2, 2}));
  REQUIRE(parts.K.size() == 12);
  // Displacements that agree at all copies have the energy and the work of the brick.
  VectorXd const u = VectorXd::LinSpaced(scene.f.size(), -1, 2);
  VectorXd copies = VectorXd::Zero(parts.unknowns());
  for (Eigen::Index j = 0; j < parts.mean.outerSize(); ++j)
    for (sparse::InnerIterator e(parts.mean, j); e; ++e) copies[e.col()] = u[e.row()];
  double energy = 0;
  Eigen::Index first = 0;
  for (auto const& K : parts.K) {
    VectorXd const own = copies.segment(first, K.rows());
    energy += own.dot(K * own);
    first += K.rows();
  }
  CHECK(first == parts.unknowns());
  CHECK(energy == doctest::Approx(u.dot(scene.K * u)).epsilon(1e-12));
  CHECK(parts.f.dot(copies) == doctest::Approx(scene.f.dot(u)).epsilon(1e-12));
  CHECK((parts.glue * copies).norm() <= 1e-13 * copies.norm());
  CHECK((parts.N * copies - scene.N * u).norm() <= 1e-13 * u.norm());
  CHECK((parts.T * copies - scene.T * u).norm() <= 1e-13 * u.norm());
  CHECK((parts.mean * copies - u).norm() <= 1e-13 * u.norm());
}

TEST_CASE("rows of the gluing are orthonormal, and no more than it takes") {
  auto const scene = fem::make_steel_brick({.k = 2});
  auto const mesh = fem::make_brick_mesh(2);
  auto const parts = fem::decompose<3>(scene, steel, fem::box_partition<3>(mesh, {2, 2, 2}));
  MatrixXd const gram = MatrixXd(parts.glue * sparse(parts.glue.transpose()));
  CHECK((gram - MatrixXd::Identity(gram.rows(), gram.cols())).norm() <= 1e-13);
  CHECK(parts.glue.rows() == parts.unknowns() - scene.f.size());
}

TEST_CASE("partitions: sizes, one part for all, what is refused") {
  auto const mesh = fem::make_brick_mesh(2);
  auto const part = fem::box_partition<3>(mesh, {3, 1, 2});
  for (int number = 0; number < 6; ++number)
    CHECK(std::count(part.begin(), part.end(), number) == mesh.cell_count() / 6);
  auto const scene = fem::make_steel_brick({.k = 2});
  auto const whole = fem::decompose<3>(scene, steel, fem::box_partition<3>(mesh, {1, 1, 1}));
  CHECK(whole.K.size() == 1);
  CHECK(whole.unknowns() == 3 * mesh.node_count());
  CHECK_THROWS_AS(static_cast<void>(fem::box_partition<3>(mesh, {3, 0, 1})), std::invalid_argument);
  CHECK_THROWS_AS(static_cast<void>(fem::decompose<3>(scene, steel, {0, 1})),
                  std::invalid_argument);
}

}  // namespace decomposition_test
