// SPDX-License-Identifier: MIT
#include <slant/contact/coulomb/coulomb_families.hpp>

#include "coulomb_scenes.hpp"
#include "counting_factor.hpp"

#include <slant/contact/coulomb/coulomb.hpp>
#include <slant/contact/preconditioners.hpp>
#include <slant/iteration/solve.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>

#include "support/message.hpp"

namespace coulomb_radii_test {

using Eigen::VectorXd;
namespace contact = slant::contact;

constexpr double tolerance = 1e-11;

/// What a run leaves of a state, so that one type of test serves all coefficients.
struct outcome {
  slant::status status;
  VectorXd λ;
  slant::work work;
  slant::index outer;
};

struct fixture {
  fem::contact_scene<3> scene;
  contact::data<double> c;
  test::counting_factor factor;
  explicit fixture(fem::brick_load load = fem::brick_load::lift, int k = 2)
      : scene(fem::make_steel_brick({.k = k, .load = load})),
        c(test::contact_data(scene)),
        factor{scene.K} {}
  [[nodiscard]] VectorXd constant(double F) const { return VectorXd::Constant(c.d.size(), F); }

  template <class Coefficient>
  [[nodiscard]] outcome solve(Coefficient const& F) {
    contact::dual problem(contact::friction_disc{}, factor, c);
    contact::coulomb_radii family(problem, F);
    auto const M = contact::lumped_preconditioner(scene.K, problem.constraints());
    auto const r = slant::solve(contact::coulomb(family, M, {.goal = tolerance}), problem.zero(),
                                slant::reduced_gradient_below(tolerance) || slant::at_most(100));
    return {r.status, r.x(), r.state.work, r.iterations()};
  }
};

TEST_CASE("Coulomb's law holds: de Saxcé's natural map of the dense problem") {
  for (auto const load : fem::brick_loads) {
    fixture t(load);
    test::dense_dual const dense(t.scene.K, t.c);
    for (double const F : {0.05, 0.3, 1.0}) {
      CAPTURE(fem::name_of(load));
      CAPTURE(F);
      auto const r = t.solve(contact::coefficients(t.constant(F)));
      REQUIRE(r.status == slant::status::converged);
      CHECK(test::natural_map(dense, t.constant(F), r.λ) <= 1e-9);
    }
  }
}

TEST_CASE("a fixed point: Tresca's problem with the bounds F λ_ν has the same solution") {
  fixture t;
  VectorXd const F = VectorXd::LinSpaced(t.c.d.size(), 0, 0.6);  // position dependent, 0 included
  auto const r = t.solve(contact::coefficients(F));
  REQUIRE(r.status == slant::status::converged);
  t.c.g = F.cwiseProduct(r.λ.head(F.size()).cwiseMax(0));
  auto const reference = test::reference(t.scene.K, t.c);
  double const size = reference.normal.cwiseAbs().maxCoeff();
  CHECK((r.λ.head(F.size()) - reference.normal).cwiseAbs().maxCoeff() <= 1e-8 * size);
  CHECK((r.λ.tail(2 * F.size()) - reference.tangential).cwiseAbs().maxCoeff() <= 1e-8 * size);
  test::dense_dual const dense(t.scene.K, t.c);
  CHECK(test::natural_map(dense, F, r.λ) <= 1e-9);
}

TEST_CASE("no friction: the solution without tangents") {
  fixture t;
  auto const r = t.solve(contact::coefficients(t.constant(0)));
  REQUIRE(r.status == slant::status::converged);
  auto const reference = test::reference(t.scene.K, test::frictionless_data(t.scene));
  double const size = reference.normal.cwiseAbs().maxCoeff();
  CHECK((r.λ.head(t.c.d.size()) - reference.normal).cwiseAbs().maxCoeff() <= 1e-8 * size);
  CHECK(r.λ.tail(t.c.T.rows()).cwiseAbs().maxCoeff() == 0);
}

TEST_CASE("much friction: what is pressed sticks") {
  fixture t(fem::brick_load::press);
  auto const r = t.solve(contact::coefficients(t.constant(1e6)));
  REQUIRE(r.status == slant::status::converged);
  test::dense_dual const dense(t.scene.K, t.c);
  VectorXd const u = dense.A * r.λ - dense.b;
  Eigen::Index const m = t.c.d.size();
  for (Eigen::Index i = 0; i < m; ++i) {
    if (r.λ(i) <= 1e-6 * r.λ.maxCoeff()) continue;
    CHECK(u.segment<2>(m + 2 * i).norm() <= 1e-9 * dense.b.cwiseAbs().maxCoeff());
  }
}

TEST_CASE("orthotropic friction: equal coefficients are isotropic, different ones make ellipses") {
  fixture t;
  auto const isotropic = t.solve(contact::coefficients(t.constant(0.3)));
  auto const equal = t.solve(contact::orthotropic_coefficients(t.constant(0.3), t.constant(0.3)));
  REQUIRE(equal.status == slant::status::converged);
  CHECK((equal.λ - isotropic.λ).norm() <= 1e-8 * isotropic.λ.norm());

  // Along its axes an ellipse is a disc in other units: t' = t / F, u' = F u, A' = F A F.
  VectorXd const F1 = t.constant(0.2), F2 = t.constant(0.5);
  auto const r = t.solve(contact::orthotropic_coefficients(F1, F2));
  REQUIRE(r.status == slant::status::converged);
  test::dense_dual dense(t.scene.K, t.c);
  Eigen::Index const m = F1.size();
  VectorXd unit = VectorXd::Ones(3 * m);
  for (Eigen::Index i = 0; i < m; ++i) {
    unit(m + 2 * i) = F1(i);
    unit(m + 2 * i + 1) = F2(i);
  }
  dense.A = unit.asDiagonal() * dense.A * unit.asDiagonal();
  dense.b = unit.cwiseProduct(dense.b);
  CHECK(test::natural_map(dense, t.constant(1), r.λ.cwiseQuotient(unit)) <= 1e-8);
  CHECK((r.λ - isotropic.λ).norm() >= 1e-3 * isotropic.λ.norm());
}

TEST_CASE("friction that falls with the slip: the coefficient is that of the slip found") {
  fixture t;
  test::dense_dual const dense(t.scene.K, t.c);
  Eigen::Index const m = t.c.d.size();
  double const length = dense.b.cwiseAbs().maxCoeff();
  auto const law = [=](double slip) { return 0.2 + 0.2 * std::exp(-slip / length); };
  auto const r = t.solve(
      contact::slip_dependent<double>(m, [=](slant::index, double slip) { return law(slip); }));
  REQUIRE(r.status == slant::status::converged);
  VectorXd const u = dense.A * r.λ - dense.b;
  VectorXd F(m);
  for (Eigen::Index i = 0; i < m; ++i) F(i) = law(u.segment<2>(m + 2 * i).norm());
  CHECK(F.maxCoeff() - F.minCoeff() >= 0.01);
  CHECK(test::natural_map(dense, F, r.λ) <= 1e-8);
}

TEST_CASE("bounds beyond the range of the scalar: as much friction as there can be") {
  fixture t(fem::brick_load::press);
  t.c.f *= 1e20;
  auto const much = t.solve(contact::coefficients(t.constant(1e6)));
  auto const most = t.solve(contact::coefficients(t.constant(1e300)));
  REQUIRE(much.status == slant::status::converged);
  REQUIRE(most.status == slant::status::converged);
  CHECK((most.λ - much.λ).norm() <= 1e-8 * much.λ.norm());
  auto const sticks = t.solve(contact::slip_dependent<double>(
      t.c.d.size(), [](slant::index, double) { return std::numeric_limits<double>::infinity(); }));
  REQUIRE(sticks.status == slant::status::converged);
  CHECK((sticks.λ - much.λ).norm() <= 1e-8 * much.λ.norm());
}

TEST_CASE("a friction law that turns negative is no other law: it is refused, with the contact") {
  fixture t;
  bool refused = false;
  try {
    static_cast<void>(t.solve(contact::slip_dependent<double>(
        t.c.d.size(), [](slant::index i, double) { return i == 2 ? -0.1 : 0.3; })));
  } catch (slant::bad_input const& e) {
    refused = std::string(e.what()).starts_with("f[2]: got -0.1, expected");
  }
  CHECK(refused);
}

TEST_CASE("nothing but what the report says, and nothing learnt about A twice") {
  fixture t;
  t.factor.solves = 0;
  auto const r = t.solve(contact::coefficients(t.constant(0.3)));
  CHECK(t.factor.solves == 1 + r.work.operator_applications + r.work.setup_applications);
}

TEST_CASE("coefficients that do not fit are refused") {
  fixture t;
  contact::dual problem(contact::friction_disc{}, t.factor, t.c);
  auto const message = [&](VectorXd const& F) -> std::string {
    return test::complaint(
        [&] { contact::coulomb_radii family(problem, contact::coefficients(F)); });
  };
  CHECK(message(t.constant(-1)) == "F[0]: got -1, expected a finite number >= 0");
  CHECK(message(VectorXd::Constant(2, 0.1)) ==
        "number of friction coefficients: got 2, expected one per contact node, 18");
}

}  // namespace coulomb_radii_test
