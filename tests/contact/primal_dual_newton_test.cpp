// SPDX-License-Identifier: MIT
//
// SSN of the lecture: in (u, λ), and with u eliminated.
#include "scenes.hpp"

#include <fem/lecture_ssn.hpp>
#include <slant/contact/dual.hpp>
#include <slant/contact/optimality.hpp>
#include <slant/contact/primal_dual.hpp>
#include <slant/factorizations/ldlt.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/operators/counted.hpp>

#include <doctest/doctest.h>

namespace primal_dual_newton_test {

using Eigen::VectorXd;
namespace contact = slant::contact;

/// The brick with k = 2 under one load, and its dual problem.
struct problem {
  fem::contact_scene<3> scene;
  contact::data<double> data;
  slant::ldlt<double> factor;
  contact::dual<contact::friction_disc, slant::ldlt<double> const&, double> dual;

  explicit problem(fem::brick_load load)
      : scene(fem::make_steel_brick({.k = 2, .load = load})),
        data(test::contact_data(scene)),
        factor(scene.K),
        dual(contact::friction_disc{}, factor, data) {}

  /// 1.9 / σ_max by power iteration.
  [[nodiscard]] double rho() const {
    auto const A = dual.a();
    VectorXd x = VectorXd::Ones(A.rows()), y(A.rows());
    double σ = 0;
    for (int i = 0; i < 60; ++i) {
      slant::apply(A, x, y);
      σ = y.norm() / x.norm();
      x = y / y.norm();
    }
    return 1.9 / σ;
  }
};

TEST_CASE("with u eliminated: solved from zero under every load") {
  for (auto const load : fem::brick_loads) {
    CAPTURE(fem::name_of(load));
    problem const p(load);
    auto const A = slant::counted(p.dual.a());
    slant::separable_qp const qp{A, p.dual.b(), p.dual.set()};
    auto const method = fem::make_lecture_ssn(qp, p.rho());
    auto const r =
        slant::solve(method, p.dual.zero(), slant::residual_below(1e-9) || slant::at_most(40));
    REQUIRE(r.converged());
    auto const u = p.dual.displacement(r.x());
    CHECK(contact::check_optimality(p.scene.K, p.data, u, r.x()).residual() <= 1e-7);
    // [K Table 6], other bricks to 1e−6: 9 steps and 1180 products at the least.
    CHECK(r.iterations() <= 14);
    CHECK(r.state.work.operator_applications <= 500);
    CHECK(A.counts().applications == r.state.work.operator_applications);
  }
}

TEST_CASE("the Newton step in (u, λ) is the one with u eliminated") {
  problem const p(fem::brick_load::pull);
  double const ρ = p.rho();
  auto const F = slant::natural_residual(p.dual.a(), p.dual.b(), p.dual.set(), ρ);
  contact::primal_dual const pair(contact::friction_disc{}, p.scene.K, p.data);
  auto const G = pair.function(ρ);
  auto const n = p.scene.f.size();
  VectorXd λ = p.dual.zero();
  slant::bicgstab_solver const solver;
  for (int step = 0; step < 3; ++step) {
    VectorXd const f = slant::evaluate(F, λ);
    auto const slant_F = F.slant(λ);
    auto prepared = solver.prepare(slant_F, f);
    VectorXd dλ(λ.size());
    static_cast<void>(solver.solve(slant_F, f, {1e-12, f.norm(), 0}, dλ, prepared));

    VectorXd y(G.cols()), dy(G.cols());
    y << p.dual.displacement(λ), λ;
    dy << p.dual.displacement(λ + dλ) - p.dual.displacement(λ), dλ;
    VectorXd const g = slant::evaluate(G, y);
    CHECK((g.tail(λ.size()) - f).norm() <= 1e-10 * f.norm());
    CHECK(g.head(n).norm() <= 1e-10 * p.scene.f.norm());
    VectorXd Gdy(G.rows());
    slant::apply(G.slant(y), dy, Gdy);
    CHECK((Gdy + g).norm() <= 1e-9 * g.norm());
    λ += dλ;
  }
}

}  // namespace primal_dual_newton_test
