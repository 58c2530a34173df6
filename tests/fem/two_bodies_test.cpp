// SPDX-License-Identifier: MIT
#include <fem/two_bricks.hpp>
#include <fem/two_plates.hpp>
#include <support/testing.hpp>

namespace two_bodies_test {

/// The lower and the upper half of the box (0,3) × … × (0,2), with the same material.
template <int D>
fem::boxes_in_contact<D> halves(int k) {
  std::array<int, D> cells;
  cells.fill(k);
  cells[0] = 3 * k;
  Eigen::Matrix<double, D, 1> size = Eigen::Matrix<double, D, 1>::Ones();
  size[0] = 3;
  auto const material = D == 2 ? fem::lame_plane_stress(7, 0.3) : fem::lame(7, 0.3);
  fem::loaded_box<D> const below{
      .mesh = fem::make_box_mesh<D>(cells, size), .material = material, .fixed = {0, false}};
  auto above = below;
  above.mesh = fem::make_box_mesh<D>(cells, size, Eigen::Matrix<double, D, 1>::Unit(D - 1));
  return {.first = above, .second = below, .contact = {D - 1, false}, .slip_bound = 0.5};
}

// Two halves that are held together at every contact node are one body: Zᵀ K Z is its stiffness,
// where Z copies the displacement of a node of the whole to both nodes of its pair.
template <int D>
void check_glued(int k) {
  auto const scene = fem::make_two_body_scene(halves<D>(k));
  std::array<int, D> cells;
  cells.fill(k);
  cells[0] = 3 * k;
  cells[D - 1] = 2 * k;
  Eigen::Matrix<double, D, 1> size = Eigen::Matrix<double, D, 1>::Ones();
  size[0] = 3;
  size[D - 1] = 2;
  auto const whole = fem::make_box_mesh<D>(cells, size);
  auto const unknowns = fem::number_unknowns(whole, [&](Eigen::Index node) {
    return whole.on({0, false}, node);
  });
  auto const material = D == 2 ? fem::lame_plane_stress(7, 0.3) : fem::lame(7, 0.3);
  auto const K = fem::stiffness<D>(whole, unknowns, material);

  Eigen::SparseMatrix<double> Z(scene.K.rows(), unknowns.count);
  for (Eigen::Index node = 0; node < scene.mesh.node_count(); ++node) {
    if (scene.unknowns.is_fixed(node)) continue;
    Eigen::Index partner = 0;
    (whole.nodes.colwise() - scene.mesh.nodes.col(node)).colwise().norm().minCoeff(&partner);
    for (int i = 0; i < D; ++i)
      Z.insert(scene.unknowns.first[node] + i, unknowns.first[partner] + i) = 1;
  }
  Eigen::SparseMatrix<double> const glued = Z.transpose() * scene.K * Z;
  CHECK((glued - K).norm() < 1e-13 * K.norm());
  // And a displacement of the whole opens no gap and slides nowhere.
  CHECK((scene.N * Z).norm() == 0);
  CHECK((scene.T * Z).norm() == 0);
}

TEST_CASE("two halves glued together are one body") {
  check_glued<2>(3);
  check_glued<3>(2);
}

TEST_CASE("rigid rotations of both bodies keep the contact closed, of one they open it") {
  auto const scene = fem::make_two_plates(2);
  VectorXd both = VectorXd::Zero(scene.K.rows());
  VectorXd upper = both;
  Eigen::Index const nodes = scene.mesh.node_count();
  for (Eigen::Index node = 0; node < nodes; ++node) {
    if (scene.unknowns.is_fixed(node)) continue;
    auto const x = scene.mesh.nodes.col(node);
    Vector2d const turned(-x[1], x[0]);
    both.segment<2>(scene.unknowns.first[node]) = turned;
    if (node < nodes / 2) upper.segment<2>(scene.unknowns.first[node]) = turned;
  }
  CHECK((scene.N * both).cwiseAbs().maxCoeff() == 0);
  CHECK((scene.T * both).cwiseAbs().maxCoeff() == 0);
  VectorXd const gap = -(scene.N * upper);
  for (Eigen::Index i = 0; i < scene.contact_count(); ++i) {
    CHECK(gap[i] == scene.contact_patches[static_cast<std::size_t>(i)].centre[0]);
    CHECK((scene.T * upper)[i] == -1);
  }
}

TEST_CASE("the loads of both scenes have the printed resultants") {
  // Force and, for the plates, moment about the origin; fixed nodes would have taken the rest, so
  // everything is summed on meshes so fine that their share is small and known.
  int const k = 20;
  auto const plates = fem::make_two_plates(k);
  auto const nodal = plates.displacement(plates.f);
  double const h = 1.0 / k;
  // Fixed nodes: (0,2), which would take ∫φ over (0, h) of the pressure 6e7 + 1e7 s.
  double const lost = 6e7 * h / 2 + 1e7 * h * h / 6;
  double const top = 3 * 6e7 + 1e7 * 9 / 2 - lost;
  CHECK(nodal.row(0).sum() == doctest::Approx(2e7).epsilon(1e-13));
  CHECK(nodal.row(1).sum() == doctest::Approx(3e7 - top).epsilon(1e-13));
  // ∫ s p_y: on the top −(6e7·9/2 + 1e7·27/3), at the end 3 ∫ (6 − 2s)e7 = 3·3e7.
  auto const& x = plates.mesh.nodes;
  double const moment = (x.row(0).array() * nodal.row(1).array()).sum();
  CHECK(moment == doctest::Approx(-(6e7 * 4.5 + 9e7) + 9e7).epsilon(1e-13));
  // ∫ y p_x at the end: 2e7 · 1.5.
  CHECK((x.row(1).array() * nodal.row(0).array()).sum() == doctest::Approx(3e7).epsilon(1e-13));
  // ∫ y p_y at the end: ∫ (6 − 2s) s over (1, 2) = 9 − 14/3; on the top y = 2.
  double const at_end = (9 - 14.0 / 3) * 1e7;
  CHECK((x.row(1).array() * nodal.row(1).array()).sum() ==
        doctest::Approx(at_end - 2 * top).epsilon(1e-13));

  auto const bricks = fem::make_two_bricks(4);
  auto const forces = bricks.displacement(bricks.f);
  CHECK(forces.topRows(2).norm() == 0);
  Eigen::Index const upper = forces.cols() / 2;
  CHECK(forces.row(2).head(upper).sum() == doctest::Approx(-(2e6 - 1e6 * 0.25)));
  CHECK(forces.row(2).tail(upper).sum() == doctest::Approx(-1e6));
}

TEST_CASE("a gap is the distance of the bodies, and sides that do not match are refused") {
  auto pair = halves<2>(2);
  pair.first.mesh = fem::make_box_mesh<2>({6, 2}, {3, 1}, {0, 1.25});
  CHECK(fem::make_two_body_scene(pair).d == VectorXd::Constant(6, 0.25));
  // The same seen from below.
  std::swap(pair.first, pair.second);
  pair.contact.upper = true;
  auto const turned = fem::make_two_body_scene(pair);
  CHECK(turned.d == VectorXd::Constant(6, 0.25));
  CHECK(turned.N.sum() == 0);

  auto const refused = [](auto change, char const* message) {
    auto wrong = halves<2>(2);
    change(wrong);
    CHECK_THROWS_WITH_AS((void)fem::make_two_body_scene(wrong), message, std::invalid_argument);
  };
  refused(
      [](auto& p) {
        p.first.mesh = fem::make_box_mesh<2>({6, 2}, {3, 1}, {0, 0.5});
      },
      "origin: got 0, expected bodies that do not overlap");
  refused(
      [](auto& p) {
        p.first.mesh = fem::make_box_mesh<2>({5, 2}, {3, 1}, {0, 1});
      },
      "cells_along: got 6, expected the same grid on both contact sides");
}

TEST_CASE("a node that only one body holds is a contact node with one side") {
  auto pair = halves<2>(2);
  pair.second.fixed = {1, false};  // the lower body stands on its bottom
  auto const scene = fem::make_two_body_scene(pair);
  CHECK(scene.contact_count() == 7);
  VectorXd const entries = scene.N.cwiseAbs() * VectorXd::Ones(scene.N.cols());
  CHECK(entries[0] == 1);
  CHECK(entries.tail(6) == VectorXd::Constant(6, 2));
}

}  // namespace two_bodies_test
