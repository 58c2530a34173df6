// SPDX-License-Identifier: MIT
#include <fem/brick_mesh.hpp>
#include <fem/elasticity.hpp>
#include <fem/surface.hpp>
#include <support/testing.hpp>

namespace elasticity_test {

template <int D>
fem::unknown_map all_unknown(fem::simplex_mesh<D> const& mesh) {
  return fem::number_unknowns(mesh, [](Eigen::Index) { return false; });
}

// Nodal values of x ↦ G x + c.
template <int D>
VectorXd affine(fem::simplex_mesh<D> const& mesh, Eigen::Matrix<double, D, D> const& G,
                Eigen::Matrix<double, D, 1> const& c) {
  Eigen::Matrix<double, D, Eigen::Dynamic> const values = (G * mesh.nodes).colwise() + c;
  return Eigen::Map<VectorXd const>(values.data(), values.size());
}

fem::lame_parameters const steel = fem::lame(2.119e5, 0.277);

TEST_CASE("the stiffness is symmetric bit for bit and positive semidefinite") {
  auto const mesh = fem::make_brick_mesh(1, {2.9, 1.1, 0.7});
  MatrixXd const K(fem::stiffness<3>(mesh, all_unknown<3>(mesh), steel));
  bool const symmetric = K == K.transpose();
  CHECK(symmetric);
  // As many zero pivots in LDLᵀ as there are rigid motions, and the others are positive.
  VectorXd pivots = K.ldlt().vectorD();
  std::sort(pivots.begin(), pivots.end());
  double const largest = pivots[pivots.size() - 1];
  CHECK(pivots.head(6).cwiseAbs().maxCoeff() < 1e-14 * largest);
  CHECK(pivots[6] > 1e-3 * largest);
}

// Patch test: for an affine displacement the discrete equilibrium is exact, that is, K u is the
// consistent load of the constant stress σ on all sides, and zero inside.
template <int D>
void check_affine(fem::box_mesh<D> const& mesh) {
  using matrix = Eigen::Matrix<double, D, D>;
  auto const unknowns = all_unknown<D>(mesh);
  auto const K = fem::stiffness<D>(mesh, unknowns, steel);
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) {
      matrix G = matrix::Zero();
      G(i, j) = 1e-3;
      matrix const ε = (G + G.transpose()) / 2;
      matrix const σ = steel.lambda * ε.trace() * matrix::Identity() + 2 * steel.mu * ε;
      VectorXd const u = affine<D>(mesh, G, Vector3d(0.1, -0.2, 0.3).head<D>());
      VectorXd load = VectorXd::Zero(unknowns.count);
      for (int axis = 0; axis < D; ++axis) {
        fem::add_traction<D>(mesh, unknowns, {axis, true}, σ.col(axis), load);
        fem::add_traction<D>(mesh, unknowns, {axis, false}, -σ.col(axis), load);
      }
      CHECK((K * u - load).cwiseAbs().maxCoeff() < 1e-11 * load.cwiseAbs().maxCoeff());
      double const energy = mesh.size.prod() * σ.cwiseProduct(ε).sum() / 2;
      CHECK(u.dot(K * u) / 2 == doctest::Approx(energy).epsilon(1e-10));
    }
}

TEST_CASE("constant strains are exact, in space and in the plane") {
  check_affine<3>(fem::make_brick_mesh(2, {2, 1.5, 0.8}));
  check_affine<2>(fem::make_box_mesh<2>({4, 3}, {2, 1.5}));
}

TEST_CASE("a plate in plane stress stretches and narrows as Hooke's law says") {
  double const E = 7e4;
  double const ν = 0.3;
  auto const mesh = fem::make_box_mesh<2>({3, 4}, {2, 1});
  auto const unknowns = all_unknown<2>(mesh);
  auto const K = fem::stiffness<2>(mesh, unknowns, fem::lame_plane_stress(E, ν));
  Eigen::Matrix2d const ε = Vector2d(1 / E, -ν / E).asDiagonal();
  VectorXd load = VectorXd::Zero(unknowns.count);
  fem::add_traction<2>(mesh, unknowns, {0, true}, {1, 0}, load);
  fem::add_traction<2>(mesh, unknowns, {0, false}, {-1, 0}, load);
  VectorXd const u = affine<2>(mesh, ε, Vector2d::Zero());
  CHECK((K * u - load).cwiseAbs().maxCoeff() < 1e-12 * load.cwiseAbs().maxCoeff());
}

TEST_CASE("fixing one side makes the stiffness positive definite") {
  auto const mesh = fem::make_brick_mesh(2);
  auto const unknowns = fem::number_unknowns(
      mesh, [&](Eigen::Index node) { return mesh.on(fem::brick_side::left, node); });
  CHECK(unknowns.count == 3 * 6 * 3 * 3);
  MatrixXd const K(fem::stiffness<3>(mesh, unknowns, steel));
  CHECK(K.llt().info() == Eigen::Success);

  // Elimination leaves out rows and columns and changes nothing else.
  MatrixXd const full(fem::stiffness<3>(mesh, all_unknown<3>(mesh), steel));
  bool same = true;
  for (Eigen::Index a = 0; a < mesh.node_count(); ++a)
    for (Eigen::Index b = 0; b < mesh.node_count(); ++b)
      if (!unknowns.is_fixed(a) && !unknowns.is_fixed(b))
        same = same && K.block<3, 3>(unknowns.first[a], unknowns.first[b]) ==
                           full.block<3, 3>(3 * a, 3 * b);
  CHECK(same);
}

TEST_CASE("an affine traction has the right resultant and the right moments") {
  // p_x = 2 + y − 3z on the right end x = 2 of the box: ∫ p, ∫ y p and ∫ z p in closed form.
  auto const mesh = fem::make_brick_mesh(2, {2, 1, 3});
  VectorXd f = VectorXd::Zero(3 * mesh.node_count());
  auto const p = [](Vector3d const& x) { return Vector3d(2 + x[1] - 3 * x[2], 0, 0); };
  fem::add_affine_traction<3>(mesh, all_unknown<3>(mesh), fem::brick_side::right, p, f);
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
}

TEST_CASE("material constants") {
  CHECK(steel.mu == doctest::Approx(2.119e5 / 2.554));
  CHECK(steel.lambda == doctest::Approx(2.119e5 * 0.277 / (1.277 * 0.446)));
  CHECK_THROWS_AS((void)fem::lame(-1, 0.3), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)fem::lame(1, 0.5),
                       "nu: got 0.5, expected a Poisson ratio in (-1, 1/2)", std::invalid_argument);
  CHECK_THROWS_AS((void)fem::lame(std::nan(""), 0.3), std::invalid_argument);
  CHECK_THROWS_AS((void)fem::lame(1, std::nan("")), std::invalid_argument);
}

}  // namespace elasticity_test
