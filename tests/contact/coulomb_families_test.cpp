// SPDX-License-Identifier: MIT
#include <slant/contact/coulomb/coulomb.hpp>

#include <slant/contact/preconditioners.hpp>
#include <slant/factorizations/ldlt.hpp>
#include <slant/iteration/solve.hpp>

#include <fem/two_plates.hpp>
#include <support/testing.hpp>
#include "coulomb_scenes.hpp"

namespace coulomb_families_test {

using namespace test::evaluated;
constexpr double tolerance = 1e-11;

/// What a run leaves of a state, so that one type of test serves all coefficients.
struct outcome {
  slant::status status;
  VectorXd λ;
};

struct fixture {
  fem::contact_scene<3> scene;
  contact::data<double> c;
  slant::ldlt<double> const factor;
  explicit fixture(fem::brick_load load = fem::brick_load::lift)
      : scene(fem::make_steel_brick({.k = 2, .load = load})),
        c(test::contact_data(scene)),
        factor(scene.K) {}
  [[nodiscard]] VectorXd constant(double F) const { return VectorXd::Constant(c.d.size(), F); }

  template <class Coefficient>
  [[nodiscard]] outcome solve(Coefficient const& F) {
    contact::dual problem(contact::friction_disc{}, factor, c);
    contact::coulomb_radii family(problem, F);
    auto const M = contact::lumped_preconditioner(scene.K, problem.constraints());
    auto const r = slant::solve(contact::coulomb(family, M, {.goal = tolerance}), problem.zero(),
                                slant::reduced_gradient_below(tolerance) || slant::at_most(100));
    return {r.status, r.x()};
  }
};

TEST_CASE("much friction: what is pressed sticks, by bounds beyond the range of the scalar too") {
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

template <class Family, class M>
auto solve(Family& family, M const& m) {
  return slant::solve(contact::coulomb(family, m, {.goal = tolerance}), family.zero(),
                      slant::reduced_gradient_below(tolerance) || slant::at_most(200));
}

/// Both families on a scene, against de Saxcé's natural map and each other.
template <class Friction, int D>
void compare(fem::contact_scene<D> const& s, double F) {
  contact::data<double> const c{s.N, s.T, s.f, s.d, s.g};
  auto const factor = slant::ldlt(s.K);
  contact::dual problem(Friction{}, factor, c);
  VectorXd const μ = VectorXd::Constant(c.d.size(), F);
  contact::coulomb_cones cones(problem, μ);
  auto const by_cones = solve(cones, contact::lumped_preconditioner(s.K, cones.constraints()));
  REQUIRE(by_cones.converged());
  VectorXd const λ = cones.by_directions(by_cones.x());
  CHECK(cones.by_contacts(λ) == by_cones.x());
  CHECK(test::natural_map(test::dense_dual(s.K, c), μ, λ) <= 1e-9);

  contact::coulomb_radii radii(problem, contact::coefficients(μ));
  auto const by_radii = solve(radii, contact::lumped_preconditioner(s.K, problem.constraints()));
  REQUIRE(by_radii.converged());
  CHECK((by_radii.x() - λ).norm() <= 1e-8 * λ.norm());
}

TEST_CASE("Coulomb's law holds, and both families find the same forces; little and much friction") {
  for (double const F : {0.0, 0.05, 0.3, 1.0}) {
    CAPTURE(F);
    for (auto const load : fem::brick_loads) {
      CAPTURE(fem::name_of(load));
      compare<contact::friction_disc>(fem::make_steel_brick({.k = 2, .load = load}), F);
    }
    compare<contact::friction_line>(fem::make_two_plates(4), F);
  }
}

}  // namespace coulomb_families_test
