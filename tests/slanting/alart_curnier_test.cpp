// SPDX-License-Identifier: MIT
#include <slant/slanting/coulomb_law.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>
#include "slanting_support.hpp"

namespace alart_curnier_test {

using slanting_support::dense_slant;
using slanting_support::random_vector;
using block = slant::alart_curnier_block<3>;

constexpr double ε = std::numeric_limits<double>::epsilon();

TEST_CASE("Alart–Curnier: the three cases and what counts at their borders") {
  block const a(0.5);
  CHECK(a.value(Vector3d(10, 3, -4)) == Vector3d(10, 3, -4));  // on the border of stick
  CHECK(a.slant(Vector3d(10, 3, -4)) == Eigen::Matrix3d::Identity());
  CHECK(a.value(Vector3d(-1, 3, 4)) == Vector3d(0, 0, 0));
  CHECK(a.slant(Vector3d(-1, 3, 4)) == Eigen::Matrix3d::Zero());
  CHECK((a.value(Vector3d(4, 3, -4)) - Vector3d(4, 1.2, -1.6)).norm() <= 2 * ε);
  Eigen::Matrix3d slip;
  slip << 1, 0, 0, 0.3, 0.4 * 0.64, 0.4 * 0.48, -0.4, 0.4 * 0.48, 0.4 * 0.36;
  CHECK((a.slant(Vector3d(4, 3, -4)) - slip).norm() <= 4 * ε);
  Eigen::Matrix3d closing = Eigen::Matrix3d::Zero();  // z_n = 0 is contact
  closing(0, 0) = 1;
  closing(1, 0) = 0.5;
  CHECK(a.slant(Vector3d(0, 2, 0)) == closing);
  CHECK(a.slant(Vector3d(0, 0, 0)) == Eigen::Matrix3d::Identity());
  block const smooth(0.0);
  CHECK(smooth.value(Vector3d(2, 3, 4)) == Vector3d(2, 0, 0));
  CHECK(smooth.slant(Vector3d(2, 0, 0)) == Vector3d(1, 0, 0).asDiagonal().toDenseMatrix());
  Vector3d const overflow(std::numeric_limits<double>::infinity(), 3, 4);
  CHECK(smooth.value(overflow).tail<2>() == Vector2d(0, 0));
  CHECK(smooth.slant(overflow) == Vector3d(1, 0, 0).asDiagonal().toDenseMatrix());
  CHECK(a.value(overflow) == overflow);
  CHECK(a.value(Vector3d(std::nan(""), 1, 1)).hasNaN());
  CHECK(a.slant(Vector3d(1, std::nan(""), 1)).hasNaN());
}

TEST_CASE("Alart–Curnier: limits at the borders and the apex, at all scales") {
  for (double s : {1e-150, 1.0, 1e150}) {
    auto const f = slant::alart_curnier_projection<3>(VectorXd{{0.5, 2.0}});
    slant::testing::check_slanting_laws(f, VectorXd(s * VectorXd{{2.0, 0.6, 0.8, 0.0, 1.0, 2.0}}),
                                        VectorXd(s * VectorXd{{1.0, 3.0, 0.0, 1.0, 0.0, 0.0}}));
  }
  auto const f = slant::alart_curnier_projection<3>(VectorXd{{0.5, 0.0}});
  slant::testing::check_slanting_laws(f, test::zeros(6));
  slant::testing::check_slanting_laws(slant::alart_curnier_projection<2>(VectorXd{{0.5, 1.0}}),
                                      VectorXd{{2.0, -1.0, 0.0, 3.0}});
}

/// The residual as it stands in the paper.
VectorXd naive(MatrixXd const& W, VectorXd const& q, VectorXd const& mu, VectorXd const& rho,
               VectorXd const& r) {
  VectorXd const u = W * r + q;
  VectorXd f = r;
  for (Eigen::Index i = 0; i < mu.size(); ++i) {
    double const n = std::max(0.0, r[3 * i] - rho[3 * i] * u[3 * i]);
    Vector2d t = r.segment<2>(3 * i + 1) - rho[3 * i + 1] * u.segment<2>(3 * i + 1);
    if (t.norm() > mu[i] * n) t *= mu[i] * n / t.norm();
    f[3 * i] -= n;
    f.segment<2>(3 * i + 1) -= t;
  }
  return f;
}

TEST_CASE(
    "Alart–Curnier: the residual with different ρ along n and t, its derivative, no allocation") {
  slant::index const n = 12;
  MatrixXd const W = slanting_support::random_spd(n, 3);
  VectorXd const q = random_vector(n, 4), mu{{0.3, 1.0, 0.0, 0.6}};
  VectorXd rho(n);
  for (int i = 0; i < 4; ++i) rho.segment<3>(3 * i) << 0.2 + i, 0.5, 0.5;
  auto const F = slant::alart_curnier<3>(W, q, mu, rho);
  VectorXd const r = 3 * random_vector(n, 5);
  CHECK((slant::evaluate(F, r) - naive(W, q, mu, rho, r)).norm() <= 1e-13);
  MatrixXd const G = dense_slant(F, r);
  for (int j = 0; j < n; ++j) {
    VectorXd const h = 1e-6 * VectorXd::Unit(n, j);
    VectorXd const d = (naive(W, q, mu, rho, r + h) - naive(W, q, mu, rho, r - h)) / 2e-6;
    CHECK((G.col(j) - d).norm() <= 1e-7 * G.norm());
  }
  slant::testing::check_slanting_laws(F, r, test::zeros(n));
  slanting_support::check_renewal(F, r);
}

TEST_CASE("Alart–Curnier: its zeros are those of the natural map with de Saxcé's velocities") {
  // Slip of a block on a table: r = (2, μ·2·(−1, 0)), u_t = (1, 0) > 0, u_n = 0.
  MatrixXd const W = MatrixXd::Identity(3, 3);
  VectorXd const mu{{0.5}}, r{{2.0, -1.0, 0.0}}, u{{0.0, 1.0, 0.0}}, q = u - W * r;
  CHECK(slant::evaluate(slant::alart_curnier<3>(W, q, mu, VectorXd::Constant(3, 0.7).eval()), r)
            .norm() <= 4 * ε);
}

TEST_CASE("Alart–Curnier: bad input is named") {
  MatrixXd const W = MatrixXd::Identity(3, 3);
  VectorXd const q = VectorXd::Zero(3);
  auto const made = [&](double μ, double n, double t) {
    return SLANT_COMPLAINT(slant::alart_curnier<3>(W, q, VectorXd{{μ}}, VectorXd{{n, 1.0, t}}));
  };
  CHECK(made(0.5, 1, 1) == "nothing thrown");
  CHECK(made(-1, 1, 1) == "mu[0]: got -1, expected a finite number >= 0");
  CHECK(made(0.5, 1, 2) == "rho[2]: got 2, expected 1 as for the other tangent of its contact");
  CHECK(made(0.5, 0, 1) == "rho[0]: got 0, expected a finite number > 0");
  CHECK(made(0.5, quiet_nan, 1) == "rho[0]: got nan, expected a finite number > 0");
  auto const of = [&](VectorXd const& load) {
    return SLANT_COMPLAINT(slant::alart_curnier<3>(W, load, VectorXd{{0.5}}, VectorXd::Ones(3)));
  };
  CHECK(of(VectorXd{{0, quiet_nan, 0}}) == "q[1]: got nan, expected a finite number");
  CHECK(of(VectorXd::Zero(2)).starts_with("q: got 2, expected the components of all contacts, 3"));
  MatrixXd const wide = MatrixXd::Identity(3, 6);
  CHECK(SLANT_COMPLAINT(slant::alart_curnier<3>(wide, q, VectorXd{{0.5}}, VectorXd::Ones(3)))
            .starts_with("W: got 3 x 6, expected 3 x 3"));
}

}  // namespace alart_curnier_test
