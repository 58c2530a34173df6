// SPDX-License-Identifier: MIT
#include <fem/brick_mesh.hpp>
#include <fem/surface.hpp>
#include <support/testing.hpp>

namespace surface_test {

fem::unknown_map all_unknown(fem::simplex_mesh<3> const& mesh) {
  return fem::number_unknowns(mesh, [](Eigen::Index) { return false; });
}

TEST_CASE("an affine traction has the right resultant and the right moments") {
  // p_x = 2 + y − 3z on the right end x = 2 of the box: ∫ p, ∫ y p and ∫ z p in closed form.
  auto const mesh = fem::make_brick_mesh(2, {2, 1, 3});
  VectorXd f = VectorXd::Zero(3 * mesh.node_count());
  auto const p = [](Vector3d const& x) { return Vector3d(2 + x[1] - 3 * x[2], 0, 0); };
  fem::add_affine_traction<3>(mesh, all_unknown(mesh), fem::brick_side::right, p, f);
  auto const forces = f.reshaped(3, mesh.node_count());
  CHECK(forces.row(0).sum() == doctest::Approx(3 * (2 + 0.5 - 4.5)).epsilon(1e-13));
  Vector3d const moment = mesh.nodes * forces.row(0).transpose();
  CHECK(moment[1] == doctest::Approx(3 * (1 + 1.0 / 3 - 2.25)).epsilon(1e-13));
  CHECK(moment[2] == doctest::Approx(9 + 2.25 - 27).epsilon(1e-13));
  CHECK(forces.bottomRows(2).isZero(0));
}

TEST_CASE("trapezoidal weights sum to the area and patches tile the side") {
  auto const mesh = fem::make_brick_mesh(2, {2.5, 0.75, 1.25});
  for (fem::box_side const side :
       {fem::brick_side::bottom, fem::brick_side::right, fem::brick_side::front}) {
    double sum = 0;
    for (int const node : mesh.nodes_on(side)) {
      auto const patch = fem::patch_of<3>(mesh, side, node);
      sum += patch.measure();
      CHECK((patch.lower.array() <= patch.centre.array()).all());
      CHECK((patch.centre.array() <= patch.upper.array()).all());
    }
    CHECK(sum == doctest::Approx(mesh.size.prod() / mesh.size[side.axis]).epsilon(1e-14));
  }
  // 6 x 2 cells of 2.5/6 x 0.75/2 on the bottom: full, half and quarter weights.
  double const cell = 2.5 / 6 * 0.75 / 2;
  auto const weight = [&](std::size_t i) {
    int const node = mesh.nodes_on(fem::brick_side::bottom)[i];
    return fem::patch_of<3>(mesh, fem::brick_side::bottom, node).measure();
  };
  CHECK(weight(0) == doctest::Approx(cell / 4));
  CHECK(weight(1) == doctest::Approx(cell / 2));
  CHECK(weight(4) == doctest::Approx(cell));
}

}  // namespace surface_test
