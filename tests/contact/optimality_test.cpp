// SPDX-License-Identifier: MIT
#include "scenes.hpp"

#include <slant/contact/optimality.hpp>
#include <support/testing.hpp>

namespace optimality_test {

struct solved {
  fem::contact_scene<3> scene;
  slant::contact::data<double> data;
  VectorXd u;
  VectorXd λ;
};

solved solve_lift() {
  auto scene = fem::make_steel_brick({.k = 2, .load = fem::brick_load::lift});
  auto data = test::contact_data(scene);
  auto const reference = test::reference(scene.K, data);
  return {std::move(scene), std::move(data), reference.u, reference.multipliers()};
}

TEST_CASE("the reference solution passes, with every residual at rounding level") {
  auto const s = solve_lift();
  auto const o = slant::contact::check_optimality(s.scene.K, s.data, s.u, s.λ);
  CHECK(o.equilibrium <= 1e-12);
  CHECK(o.normal <= 1e-12);
  CHECK(o.friction <= 1e-12);
  CHECK(o.penetration <= 1e-12);
  CHECK(o.adhesion <= 1e-12);
  CHECK(o.cone <= 1e-12);
  CHECK(o.residual() == std::max({o.equilibrium, o.normal, o.friction}));
}

TEST_CASE("each kind of violation shows in its own number") {
  auto const s = solve_lift();
  auto const check = [&](VectorXd const& u, VectorXd const& λ) {
    return slant::contact::check_optimality(s.scene.K, s.data, u, λ);
  };
  VectorXd u = s.u;
  Eigen::Index largest = 0;
  u.cwiseAbs().maxCoeff(&largest);
  u(largest) *= 1.01;
  CHECK(check(u, s.λ).equilibrium > 1e-6);

  VectorXd λ = s.λ;
  λ(0) = -0.1 * s.data.f.norm();
  CHECK(check(s.u, λ).adhesion == doctest::Approx(0.1).epsilon(0.1));
  CHECK(check(s.u, λ).normal > 0.05);

  λ = s.λ;
  λ.tail(s.data.T.rows()) *= 2;
  CHECK(check(s.u, λ).cone > 1e-4);
  CHECK(check(s.u, λ).friction > 1e-4);

  CHECK(check(-s.u, s.λ).penetration > 1e-4);
}

TEST_CASE("residuals have no units") {
  auto const s = solve_lift();
  VectorXd const u = 1.001 * s.u, λ = 0.999 * s.λ;
  auto const plain = slant::contact::check_optimality(s.scene.K, s.data, u, λ);
  auto scaled = s.data;
  double const k = 0x1p60, t = 0x1p-30;
  scaled.f *= t;
  scaled.g *= t;
  scaled.d *= t / k;
  Eigen::SparseMatrix<double> const K = k * s.scene.K;
  auto const other =
      slant::contact::check_optimality(K, scaled, VectorXd(u * (t / k)), VectorXd(λ * t));
  CHECK(other.equilibrium == doctest::Approx(plain.equilibrium).epsilon(1e-12));
  CHECK(other.normal == doctest::Approx(plain.normal).epsilon(1e-12));
  CHECK(other.friction == doctest::Approx(plain.friction).epsilon(1e-12));
}

TEST_CASE("a number that is none is never overlooked") {
  auto const s = solve_lift();
  for (Eigen::Index i : {0, 5, 20}) {
    VectorXd u = s.u, λ = s.λ;
    u(i) = std::nan("");
    CHECK(std::isnan(slant::contact::check_optimality(s.scene.K, s.data, u, s.λ).residual()));
    λ(i) = std::nan("");
    CHECK(std::isnan(slant::contact::check_optimality(s.scene.K, s.data, s.u, λ).residual()));
  }
}

TEST_CASE("nothing loaded, nothing moved") {
  auto const s = solve_lift();
  auto c = s.data;
  c.f.setZero();
  VectorXd const u = VectorXd::Zero(s.u.size()), λ = VectorXd::Zero(s.λ.size());
  CHECK(slant::contact::check_optimality(s.scene.K, c, u, λ).residual() == 0);
  CHECK(slant::contact::check_optimality(s.scene.K, c, s.u, λ).residual() > 0.1);
  c.d.setConstant(-1);  // pressed in, so nothing is as it should be
  CHECK(slant::contact::check_optimality(s.scene.K, c, u, λ).residual() == 1);
}

/// A chain of springs between two walls, every node held from below: u = 0, λ = f.
struct held_chain {
  Eigen::SparseMatrix<double> K;
  slant::contact::data<double> data;
};

held_chain make_held_chain() {
  Eigen::Index const n = 9;
  Eigen::SparseMatrix<double> N(n, n);
  N.setIdentity();
  return {test::springs(n),
          {N, Eigen::SparseMatrix<double>(0, n), VectorXd::LinSpaced(n, 0.1, 0.2),
           VectorXd::Zero(n), VectorXd(0)}};
}

TEST_CASE("a body that hardly moves: errors of λ and u count as much as they are") {
  auto const [K, c] = make_held_chain();
  VectorXd const zero = VectorXd::Zero(c.f.size());
  VectorXd const noise = VectorXd::LinSpaced(c.f.size(), 3, 27).array().sin();
  auto const residual = [&, &K = K, &c = c](VectorXd const& u, VectorXd const& λ) {
    return slant::contact::check_optimality(K, c, u, λ).residual();
  };
  CHECK(residual(zero, c.f) == 0);
  MatrixXd const inverse_of_K = MatrixXd(K).inverse();
  double const κ = 2, condition = 4 * inverse_of_K.norm();  // ‖K‖ < 4
  for (double const ε : {1e-4, 1e-8, 1e-12, 1e-15, 1e-17}) {
    CAPTURE(ε);
    // λ is off by ε, u belongs to it.
    VectorXd const λ = c.f + ε * c.f.norm() / noise.norm() * noise;
    VectorXd const u = inverse_of_K * (c.f - λ);
    CHECK(residual(u, λ) <= condition * ε);
    // λ is exact, u is off by ε: a force of ε per spring.
    CHECK(residual(ε * noise, c.f) <= 2 * κ * ε * noise.norm() / c.f.norm());
    CHECK(residual(ε * noise, c.f) >= 0.1 * ε);
  }
}

TEST_CASE("a body that hardly moves: still no units") {
  auto const [K, c] = make_held_chain();
  VectorXd const u = VectorXd::LinSpaced(c.f.size(), 1e-17, 2e-17), λ = 1.25 * c.f;
  auto const plain = slant::contact::check_optimality(K, c, u, λ);
  for (double const k : {0x1p-80, 0x1p80}) {
    for (double const t : {0x1p-70, 0x1p70}) {
      auto scaled = c;
      scaled.f *= t;
      Eigen::SparseMatrix<double> const stiff = k * K;
      auto const other =
          slant::contact::check_optimality(stiff, scaled, VectorXd(u * (t / k)), VectorXd(λ * t));
      CHECK(other.equilibrium == plain.equilibrium);
      CHECK(other.normal == plain.normal);
      CHECK(other.penetration == plain.penetration);
    }
  }
}

TEST_CASE("a multiplier that presses on nothing is measured too") {
  auto [K, c] = make_held_chain();
  c.f.setZero();
  c.N.coeffRef(0, 0) = 0;
  VectorXd const u = VectorXd::Zero(c.f.size());
  VectorXd λ = u;
  λ(0) = -3;
  CHECK(slant::contact::check_optimality(K, c, u, λ).residual() == 1);
  CHECK(slant::contact::check_optimality(K, c, u, λ).adhesion == 1);
}

TEST_CASE("data and sizes are checked") {
  auto const s = solve_lift();
  using slant::contact::check_optimality;
  VectorXd const u = VectorXd::Zero(s.u.size()), λ = VectorXd::Zero(s.λ.size());
  auto const complaint = [&](auto const& K, auto const& c, auto const& x, auto const& y) {
    return SLANT_COMPLAINT(check_optimality(K, c, x, y));
  };
  auto const& K = s.scene.K;
  CHECK(complaint(K, s.data, u, λ) == "nothing thrown");
  CHECK(complaint(MatrixXd(K), s.data, u, λ) == "nothing thrown");
  CHECK(complaint(K, s.data, λ, λ).starts_with("u: got"));
  CHECK(complaint(K, s.data, u, u).starts_with("lambda: got"));
  auto c = s.data;
  c.d.conservativeResize(c.d.size() - 1);
  CHECK(complaint(K, c, u, λ).starts_with("d: got"));
  Eigen::Index const n = K.rows();
  Eigen::SparseMatrix<double> const short_K = K.topRows(n - 1), narrow_K = K.leftCols(n - 1);
  CHECK(complaint(short_K, s.data, u, λ).starts_with("rows of K: got"));
  CHECK(complaint(narrow_K, s.data, u, λ).starts_with("columns of K: got"));
  CHECK(complaint(Eigen::SparseMatrix<double>(-K), s.data, u, λ)
            .starts_with("largest diagonal entry of K: got -"));
  slant::contact::data<double> const nothing{
      Eigen::SparseMatrix<double>(1, 0), {}, VectorXd(0), VectorXd::Zero(1), VectorXd(0)};
  CHECK(complaint(Eigen::SparseMatrix<double>(0, 0), nothing, VectorXd(0), VectorXd(1))
            .starts_with("largest diagonal entry of K: got 0"));
}

}  // namespace optimality_test
