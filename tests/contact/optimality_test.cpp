// SPDX-License-Identifier: MIT
#include "scenes.hpp"

#include <slant/contact/optimality.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

namespace optimality_test {

using Eigen::VectorXd;

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
  VectorXd λ(reference.normal.size() + reference.tangential.size());
  λ << reference.normal, reference.tangential;
  return {std::move(scene), std::move(data), reference.u, λ};
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

TEST_CASE("nothing loaded, nothing moved; sizes are checked") {
  auto const s = solve_lift();
  auto c = s.data;
  c.f.setZero();
  VectorXd const u = VectorXd::Zero(s.u.size()), λ = VectorXd::Zero(s.λ.size());
  CHECK(slant::contact::check_optimality(s.scene.K, c, u, λ).residual() == 0);
  CHECK(slant::contact::check_optimality(s.scene.K, c, s.u, λ).residual() > 0.1);
  CHECK_THROWS_AS(static_cast<void>(slant::contact::check_optimality(s.scene.K, c, λ, λ)),
                  slant::bad_input);
  CHECK_THROWS_AS(static_cast<void>(slant::contact::check_optimality(s.scene.K, c, u, u)),
                  slant::bad_input);
}

}  // namespace optimality_test
