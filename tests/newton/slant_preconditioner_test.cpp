// SPDX-License-Identifier: MIT
#include <slant/slant.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>
#include "newton_scene.hpp"

namespace slant_preconditioner_test {

using namespace test::evaluated;
/// Eigenvalues of M^½ H M^½ for eigenvectors in range(G); those in the kernel are zero.
VectorXd preconditioned_spectrum(MatrixXd const& H, MatrixXd const& M) {
  MatrixXd const L = M.llt().matrixL();
  return test::eigenvalues_of(L.transpose() * H * L);
}

TEST_CASE("the spectrum lies between min(1, ρσ_min) and max(1, ρσ_max), however small G is") {
  newton_scene::data const d(6);
  auto const A = d.definite();
  VectorXd const x = slanting_support::random_vector(18, 7);
  VectorXd const σ = test::eigenvalues_of(d.A);
  for (double smallest : {1.0, 1e-3, 1e-9}) {
    for (double ρ : {0.1 * d.ρ, d.ρ, 10 * d.ρ}) {
      auto const set = newton_scene::contact_set(6, smallest);
      auto const F = slant::natural_residual(A, d.b, set, ρ);
      auto const N = F.slant(x);
      auto const& G = slant::slant_of_projection(N);
      slant::slant_preconditioner const preconditioner(G);
      static_assert(decltype(preconditioner)::effective);
      VectorXd const spectrum =
          preconditioned_spectrum(slanting_support::dense(slant::symmetrized(N), x),
                                  slanting_support::dense(preconditioner, x));
      // range(G): free bounds, both directions of sticking discs, one of sliding discs.
      slant::index rank = 0;
      for (int i = 0; i < 6; ++i) {
        MatrixXd const disc = G.part<1>().block(i);
        bool const sticks = disc == MatrixXd(MatrixXd::Identity(2, 2));
        rank += slant::index(G.part<0>().block(i)(0, 0)) + (sticks ? 2 : 1);
      }
      REQUIRE(rank > 6);
      REQUIRE(rank < 18);
      CAPTURE(smallest);
      CAPTURE(ρ);
      VectorXd const inside = spectrum.tail(rank);
      CHECK(inside.minCoeff() >= std::min(1.0, ρ * σ[0]) * (1 - 1e-6));
      CHECK(inside.maxCoeff() <= std::max(1.0, ρ * σ[17]) * (1 + 1e-6));
      CHECK(spectrum.head(18 - rank).cwiseAbs().maxCoeff() <= 1e-6);
    }
  }
}

TEST_CASE("cones, whose blocks have different eigenvalues; the law of M; G = 0") {
  auto const cones = slant::power(slant::second_order_cone<3>{0.5}, 4);
  VectorXd y = slanting_support::random_vector(12, 3);
  y.segment<3>(0) << 5, 0.1, 0;   // inside or not, whatever the order of the components is:
  y.segment<3>(3) << -5, 0, 0.1;  // one of these is in the polar cone, where G = 0
  y.segment<3>(6) << 0.1, 0, -5;
  auto const G = slant::projection_slant(cones, y);
  slant::slant_preconditioner preconditioner(G);
  slant::testing::check_operator_laws(preconditioner, y);
  MatrixXd const g = slanting_support::dense(G, y);
  MatrixXd const m = slanting_support::dense(preconditioner, y);
  CHECK((g * m * g - g).norm() <= 1e-6 * g.norm());  // a pseudo-inverse
  bool zero_seen = false;
  for (int i = 0; i < 4; ++i) {
    if (g.block<3, 3>(3 * i, 3 * i).isZero(0)) {
      zero_seen = true;
      CHECK(m.block<3, 3>(3 * i, 3 * i) == MatrixXd(MatrixXd::Identity(3, 3)));
    }
  }
  CHECK(zero_seen);
  // Assigned anew, it is that of the other operator.
  auto const other = slant::projection_slant(cones, VectorXd(-y));
  preconditioner.assign(other);
  CHECK(slanting_support::dense(preconditioner, y) ==
        slanting_support::dense(slant::slant_preconditioner(other), y));
}

TEST_CASE("blocks that are not accessible are left alone") {
  auto const G = slant::matrix(MatrixXd(2 * MatrixXd::Identity(3, 3)));
  slant::slant_preconditioner const preconditioner(G);
  static_assert(!decltype(preconditioner)::effective);
  VectorXd const x = slanting_support::random_vector(3, 1);
  VectorXd y(3);
  slant::apply(preconditioner, x, y);
  CHECK(y == x);
}

}  // namespace slant_preconditioner_test
