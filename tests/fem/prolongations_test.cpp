// SPDX-License-Identifier: MIT
#include <fem/contact_prolongation.hpp>
#include <fem/grid_prolongation.hpp>
#include <fem/steel_brick.hpp>
#include <fem/wire_prolongation.hpp>
#include <oracle/wire_reference.hpp>
#include <support/testing.hpp>

namespace prolongations_test {

using grid = fem::rectangle_grid<>;

TEST_CASE("the same as the naive interpolation, the identity on the same grid") {
  grid const coarse{4, 3, 3, 2};
  VectorXd const v = VectorXd::LinSpaced(12, -2, 5).array().sin();
  auto const value = [&](Eigen::Index i, Eigen::Index j) {
    bool const interior = i >= 0 && j >= 0 && i < 4 && j < 3;
    return interior ? v[coarse.unknown(i, j)] : 0.0;
  };
  for (auto const& fine :
       {grid{11, 6, 3, 2}, {4, 4, 3, 2}, {7, 9, 3, 2}, {2, 13, 3, 2}, {1, 1, 3, 2}}) {
    VectorXd const to = fem::grid_prolongation(coarse, fine) * v;
    VectorXd const naive = fem::at_nodes(fine, [&](double x, double y) {
      auto const i = static_cast<Eigen::Index>(std::floor(x / coarse.hx())) - 1;
      auto const j = static_cast<Eigen::Index>(std::floor(y / coarse.hy())) - 1;
      double const right = x / coarse.hx() - static_cast<double>(i + 1);
      double const up = y / coarse.hy() - static_cast<double>(j + 1);
      return (1 - up) * ((1 - right) * value(i, j) + right * value(i + 1, j)) +
             up * ((1 - right) * value(i, j + 1) + right * value(i + 1, j + 1));
    });
    CHECK((to - naive).cwiseAbs().maxCoeff() < 1e-14);
  }
  CHECK(MatrixXd(fem::grid_prolongation(coarse, coarse)).isIdentity(1e-15));
}

TEST_CASE("what does not fit is refused") {
  auto const check = [](grid const& coarse, grid const& fine, char const* what) {
    CHECK_THROWS_WITH_AS((void)fem::grid_prolongation(coarse, fine), what, std::invalid_argument);
  };
  check({3, 3, 1, 1}, {3, 3, 2, 1}, "width: got 2, expected that of the coarse grid");
  check({3, 3, 1, 1}, {3, 3, 1, 3}, "height: got 3, expected that of the coarse grid");
  check({0, 3, 1, 1}, {3, 3, 1, 1}, "nx: got 0, expected between 1 and 2^15 nodes");
}

/// Forces of a stress that is linear in the place, different in each component.
template <int D>
VectorXd forces(fem::contact_scene<D> const& scene, double slope) {
  Eigen::Index const m = scene.contact_count();
  VectorXd λ(D * m);
  for (Eigen::Index i = 0; i < m; ++i) {
    double const along = scene.contact_patches[static_cast<std::size_t>(i)].centre.sum();
    double const stress = 2 + slope * along;
    λ[i] = scene.contact_weights[i] * stress;
    for (int t = 0; t < D - 1; ++t)
      λ[m + (D - 1) * i + t] = -(t + 3) * scene.contact_weights[i] * stress;
  }
  return λ;
}

TEST_CASE("contact: forces of linear stresses become those of the other mesh") {
  for (int const k : {2, 3, 4, test::effort(7, 5)}) {
    auto const coarse = fem::make_steel_brick({.k = 2});
    auto const fine = fem::make_steel_brick({.k = k});
    auto const P = fem::contact_prolongation(coarse, fine);
    for (double const slope : {0.0, 1.5})
      CHECK((P * forces(coarse, slope) - forces(fine, slope)).cwiseAbs().maxCoeff() < 1e-13);
    // The identity from a mesh to itself, bit for bit.
    if (k == 2) CHECK((P * forces(coarse, 1) - forces(coarse, 1)).cwiseAbs().maxCoeff() == 0);
  }
}

TEST_CASE("contact: from fine to coarse and in the plane") {
  auto const plate = [](int k) {
    return fem::make_contact_scene<2>({.mesh = fem::make_box_mesh<2>({3 * k, k}, {3, 1}),
                                       .material = fem::lame_plane_stress(2e5, 0.3),
                                       .fixed = {0, false},
                                       .contact = {1, false}});
  };
  auto const P = fem::contact_prolongation(plate(5), plate(3));
  CHECK((P * forces(plate(5), 2) - forces(plate(3), 2)).cwiseAbs().maxCoeff() < 1e-13);
}

TEST_CASE("contact nodes that are no grid are refused") {
  auto scene = fem::make_steel_brick({.k = 1});
  auto const fine = fem::make_steel_brick({.k = 2});
  scene.contact_patches.pop_back();
  CHECK_THROWS_WITH_AS((void)fem::contact_prolongation(scene, fine),
                       "contact_patches: got 5, expected one node at each point of a grid",
                       std::invalid_argument);
  scene.contact_patches.push_back(scene.contact_patches.front());
  CHECK_THROWS_AS((void)fem::contact_prolongation(scene, fine), std::invalid_argument);
}

TEST_CASE("between two points of a line, and beyond them") {
  auto const at = fem::interpolate<double>({0, 1, 3}, {-1, 0, 0.25, 1, 2, 3, 5});
  double const value[] = {10, 20, 60};
  double const expected[] = {0, 10, 12.5, 20, 40, 60, 100};
  for (std::size_t i = 0; i < at.size(); ++i)
    CHECK((1 - at[i].weight) * value[at[i].left] + at[i].weight * value[at[i].right] ==
          expected[i]);
  auto const constant = fem::interpolate<double>({2}, {1, 2, 3});
  for (auto const& place : constant) CHECK((place.left == 0 && place.weight == 0));
  CHECK_THROWS_WITH_AS((void)fem::interpolate<double>({0, 1, 1}, {0}),
                       "from: got 1, expected increasing points", std::invalid_argument);
  CHECK_THROWS_AS((void)fem::interpolate<double>({}, {0}), std::invalid_argument);
}

TEST_CASE("the wire: the same as the naive interpolation") {
  auto const coarse = fem::make_wire<oracle::real>(8);
  oracle::real_vector x = oracle::real_vector::LinSpaced(32, -1, 2).array().square();
  for (Eigen::Index const m : {5, 16, 33}) {
    auto const fine = fem::make_wire<oracle::real>(m);
    oracle::real_vector const y = fem::wire_prolongation(coarse, fine) * x;
    CHECK((y - oracle::interpolate(coarse, x, fine)).cwiseAbs().maxCoeff() < 1e-17L);
  }
}

}  // namespace prolongations_test
