// SPDX-License-Identifier: MIT
#include <slant/operators/matrix.hpp>
#include <slant/testing/operator_laws.hpp>

#include <doctest/doctest.h>

#include <fem/contact_prolongation.hpp>
#include <fem/steel_brick.hpp>
#include <fem/wire_prolongation.hpp>
#include <support/effort.hpp>

namespace contact_prolongation_test {

/// Forces of a stress that is linear in the place, different in each component.
template <int D>
Eigen::VectorXd forces(fem::contact_scene<D> const& scene, double slope) {
  Eigen::Index const m = scene.contact_count();
  Eigen::VectorXd λ(D * m);
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

TEST_CASE("contact: from fine to coarse and in the plane, with the laws of an operator") {
  auto const plate = [](int k) {
    return fem::make_contact_scene<2>({.mesh = fem::make_box_mesh<2>({3 * k, k}, {3, 1}),
                                       .material = fem::lame_plane_stress(2e5, 0.3),
                                       .fixed = {0, false},
                                       .contact = {1, false}});
  };
  auto const P = fem::contact_prolongation(plate(5), plate(3));
  CHECK((P * forces(plate(5), 2) - forces(plate(3), 2)).cwiseAbs().maxCoeff() < 1e-13);
  slant::testing::check_operator_laws(slant::matrix(P));
  auto const space =
      fem::contact_prolongation(fem::make_steel_brick({.k = 1}), fem::make_steel_brick({.k = 2}));
  slant::testing::check_operator_laws(slant::matrix(space));
}

TEST_CASE("the prolongation of the wire keeps the laws of an operator and of its adjoint") {
  auto const P = slant::matrix(fem::wire_prolongation(fem::make_wire(4), fem::make_wire(8)));
  static_assert(slant::has_adjoint<decltype(P), Eigen::VectorXd>);
  slant::testing::check_operator_laws(P);
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

}  // namespace contact_prolongation_test
