// SPDX-License-Identifier: MIT
#include <slant/sets/sets.hpp>
#include <slant/slanting/slanting.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>
#include "oracle/hard_points.hpp"
#include "oracle/naive_projections.hpp"
#include "oracle/precise.hpp"
#include "oracle/set_checks.hpp"
#include "slanting_support.hpp"

namespace de_saxce_test {

using oracle::float_50;
using slanting_support::dense_slant;
using slanting_support::random_vector;

constexpr double ε = std::numeric_limits<double>::epsilon();

TEST_CASE("de Saxcé: known values and derivatives, e = 0 where nothing slides") {
  auto const f = slant::de_saxce<3>(VectorXd{{0.5, 2.0, 0.0}});
  VectorXd const u{{1.0, 3.0, -4.0, -1.0, 0.0, 0.0, 2.0, 1.0, 1.0}};
  CHECK(slant::evaluate(f, u) == VectorXd{{3.5, 3.0, -4.0, -1.0, 0.0, 0.0, 2.0, 1.0, 1.0}});
  MatrixXd expected = MatrixXd::Identity(9, 9);
  expected(0, 1) = 0.5 * 0.6;
  expected(0, 2) = 0.5 * -0.8;
  CHECK((dense_slant(f, u) - expected).norm() <= ε);
  CHECK(slant::evaluate(slant::de_saxce<2>(VectorXd{{0.5}}), VectorXd{{1.0, -4.0}}) ==
        VectorXd{{3.0, -4.0}});
}

TEST_CASE("de Saxcé: slanting against differences in 50 digits, at all scales") {
  oracle::number_source<double> source(1);
  for (int i = 0; i < 60; ++i) {
    double const scale = source.positive_of_size(-150, 150);
    double const μ = source.positive_of_size(-2, 1);
    Vector3d const u = scale * source.direction<3>();
    auto const exact = [&](auto const& z) {
      auto v = z;
      v(0) += float_50(μ) * sqrt(float_50(z(1) * z(1) + z(2) * z(2)));
      return v;
    };
    slant::de_saxce_block<3> const block(μ);
    auto const wide = oracle::widen<float_50>(u);
    double worst = 0;
    Vector3d const computed = block.value(u);
    for (int k = 0; k < 3; ++k) {
      // The sum u_n + μ‖u_t‖ may cancel: measured by its terms.
      worst = std::max(worst, std::abs(double((float_50(computed(k)) - exact(wide)(k)) /
                                              float_50((1 + μ) * scale))));
    }
    CHECK(worst <= 4 * ε);
    auto const J =
        oracle::differences<float_50, 3, 3>(exact, wide, float_50(scale) * float_50(1e-18));
    Eigen::Matrix3d const G = block.slant(u);
    for (int k = 0; k < 9; ++k)
      CHECK(std::abs(G(k / 3, k % 3) - double(J(k / 3, k % 3))) <= 4 * ε * (1 + μ));
  }
}

TEST_CASE("de Saxcé: the limit at u_t = 0, on the axis and at 0") {
  auto const f = slant::de_saxce<3>(VectorXd{{0.5, 2.0}});
  slant::testing::check_slanting_laws(f, VectorXd{{1.0, 0.0, 0.0, -3.0, 0.0, 0.0}},
                                      VectorXd{{0.0, 1.0, 0.0, 0.0, 0.0, 0.0}}, test::zeros(6));
  slant::testing::check_slanting_laws(slant::de_saxce<2>(VectorXd{{0.5, 2.0}}),
                                      VectorXd{{1.0, 0.0, -3.0, -0.25}});
}

TEST_CASE(
    "the natural map r − P(r − ρ û(W r + q)) as a client writes it: values, chain rule, laws") {
  slant::index const n = 9;
  MatrixXd const W = slanting_support::random_spd(n, 3);
  VectorXd const q = random_vector(n, 4), mu{{0.3, 1.0, 0.0}};
  double const ρ = 0.25;
  auto const K = slant::power(slant::second_order_cone<3>{}, mu);
  auto const F =
      slant::identity_map(n) -
      slant::projection(K) * (slant::identity_map(n) -
                              slant::positive(ρ) * (slant::de_saxce<3>(mu) * slant::affine(W, q)));
  VectorXd const r = 3 * random_vector(n, 5);
  VectorXd const u = W * r + q;
  VectorXd expected = r;
  MatrixXd slope = MatrixXd::Identity(n, n);
  for (slant::index i = 0; i < 3; ++i) {
    Vector3d hat = u.segment<3>(3 * i);
    double const slip = hat.tail<2>().norm();
    Eigen::Matrix3d H = Eigen::Matrix3d::Identity();
    H.block<1, 2>(0, 1) = mu[i] * hat.tail<2>().transpose() / slip;
    hat(0) += mu[i] * slip;
    Vector3d const z = r.segment<3>(3 * i) - ρ * hat;
    expected.segment<3>(3 * i) -= naive::project_cone<double, 3>(z, mu[i]);
    MatrixXd inner = -ρ * H * W.middleRows<3>(3 * i);
    inner.middleCols<3>(3 * i) += Eigen::Matrix3d::Identity();
    slope.middleRows<3>(3 * i) -= K.block(i).slant(z) * inner;
  }
  CHECK((slant::evaluate(F, r) - expected).norm() <= 1e-14);
  CHECK((dense_slant(F, r) - slope).norm() <= 1e-14 * slope.norm());
  slant::testing::check_slanting_laws(F, r, test::zeros(n));
  slanting_support::check_renewal(F, r);

  MatrixXd columns(n, n);
  F.slant(r).columns(0, columns);  // what direct solvers take
  CHECK((columns - slope).norm() <= 1e-14 * slope.norm());
}

TEST_CASE("de Saxcé: orthotropic friction") {
  auto const f = slant::de_saxce(VectorXd{{2.0, 0.5}}, VectorXd{{0.5, 0.0}});
  VectorXd const u{{1.0, 1.5, -8.0, 1.0, -2.0, 7.0}};
  VectorXd expected = u;
  expected[0] += 5;  // ‖(3, −4)‖
  expected[3] += 1;
  CHECK((slant::evaluate(f, u) - expected).norm() <= 4 * ε);
  MatrixXd slope = MatrixXd::Identity(6, 6);
  slope(0, 1) = 2.0 * 0.6;
  slope(0, 2) = 0.5 * -0.8;
  slope(3, 4) = -0.5;
  CHECK((dense_slant(f, u) - slope).norm() <= 2 * ε);
  slant::testing::check_slanting_laws(f, u, VectorXd{{1.0, 0.0, 0.0, 1.0, 0.0, 3.0}});
}

TEST_CASE("de Saxcé: bad input is named") {
  auto const made = [](double μ) {
    return test::complaint([=] { (void)slant::de_saxce<3>(VectorXd{{1.0, μ}}); });
  };
  CHECK(made(-1) == "mu[1]: got -1, expected a finite number >= 0");
  CHECK(made(std::numeric_limits<double>::infinity()) ==
        "mu[1]: got inf, expected a finite number >= 0");
  CHECK(made(0) == "nothing thrown");
}

}  // namespace de_saxce_test
