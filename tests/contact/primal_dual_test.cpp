// SPDX-License-Identifier: MIT
#include <slant/contact/primal_dual.hpp>

#include <slant/contact/dual.hpp>
#include <slant/contact/optimality.hpp>
#include <slant/factorizations/ldlt.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/operators/counted.hpp>

#include <fem/lecture_ssn.hpp>
#include <slanting/slanting_support.hpp>
#include <support/testing.hpp>
#include "scenes.hpp"

namespace primal_dual_test {

using namespace test::evaluated;
using slanting_support::dense_slant;
using slanting_support::random_vector;

/// The second and third block row of G° as they stand in [K] below (53), rows and columns in the
/// order of (46). Active is what is not on the boundary: (52), (53).
MatrixXd hand_derived(Eigen::SparseMatrix<double> const& K, contact::data<double> const& c,
                      VectorXd const& y, double ρ) {
  auto const n = K.rows(), m = c.nodes();
  auto const k = c.tangents();
  MatrixXd const N(c.N), T(c.T);
  MatrixXd G = MatrixXd::Zero(n + (1 + k) * m, n + (1 + k) * m);
  G.topLeftCorner(n, n) = MatrixXd(K);
  G.block(0, n, n, m) = N.transpose();
  G.block(0, n + m, n, k * m) = T.transpose();
  VectorXd const u = y.head(n);
  VectorXd const zn = y.segment(n, m) + ρ * (c.N * u - c.d);
  VectorXd const zt = y.tail(k * m) + ρ * (c.T * u);
  for (Eigen::Index i = 0; i < m; ++i) {
    if (zn[i] >= 0) {
      G.row(n + i).head(n) = -ρ * N.row(i);
    } else {
      G(n + i, n + i) = 1;
    }
    VectorXd const z = zt.segment(k * i, k);
    auto const rows = Eigen::seqN(n + m + k * i, k);
    if (z.norm() <= c.g[i]) {
      G(rows, Eigen::seqN(0, n)) = -ρ * T.middleRows(k * i, k);
    } else if (k == 1) {
      G(n + m + i, n + m + i) = 1;
    } else {  // ψ° = (g/‖z‖)(I − zzᵀ/‖z‖²), 1 − z₁²/‖z‖² = z₂²/‖z‖²
      double const τ = c.g[i] / z.norm();
      Vector2d const e = z / z.norm();
      Eigen::Matrix2d const ψ =
          τ * Eigen::Matrix2d{{e[1] * e[1], -e[0] * e[1]}, {-e[0] * e[1], e[0] * e[0]}};
      G(rows, Eigen::seqN(0, n)) = -ρ * (ψ * T.middleRows(2 * i, 2));
      G.block<2, 2>(n + m + 2 * i, n + m + 2 * i) = Eigen::Matrix2d::Identity() - ψ;
    }
  }
  return G;
}

template <class Friction>
void check_operator(Friction friction, Eigen::SparseMatrix<double> const& K,
                    contact::data<double> const& c) {
  contact::primal_dual const problem(friction, K, c);
  double const ρ = 1e4;
  auto const G = problem.function(ρ);
  for (unsigned seed = 1; seed <= 3; ++seed) {
    VectorXd y = random_vector(G.cols(), seed);
    y.head(K.rows()) *= 1e-5;
    y.segment(K.rows(), c.nodes()) *= 0.1;
    MatrixXd const composed = dense_slant(G, y), hand = hand_derived(K, c, y, ρ);
    // What is an entry of K, B or −ρB, 0 or 1 is so exactly; ψ° up to the roundings of its formula.
    CHECK(composed.topRows(K.rows()) == hand.topRows(K.rows()));
    CHECK(((composed - hand).array().abs() <= 8e-16 * hand.array().abs()).all());
    MatrixXd const exact = (composed.array() == hand.array()).cast<double>();
    CHECK(exact.middleRows(K.rows(), c.nodes()).minCoeff() == 1);
  }
}

TEST_CASE("the operator of the lecture, to the last digit") {
  auto const scene = fem::make_steel_brick({.k = 2, .load = fem::brick_load::pull});
  check_operator(contact::friction_disc{}, scene.K, test::contact_data(scene));
  check_operator(contact::friction_line{}, scene.K, test::one_tangent(scene));
}

TEST_CASE("zero at the solution") {
  auto const scene = fem::make_steel_brick({.k = 2, .load = fem::brick_load::lift});
  auto const c = test::contact_data(scene);
  auto const reference = test::reference(scene.K, c);  // of an oracle, not of the dual problem
  contact::primal_dual const problem(contact::friction_disc{}, scene.K, c);
  auto const G = problem.function(1e4);
  VectorXd y(G.cols());
  y << reference.u, reference.normal, reference.tangential;
  CHECK(slant::evaluate(G, y).norm() <= 1e-13 * (scene.K * reference.u).norm());
  CHECK(problem.displacement(y) == reference.u);
  CHECK(problem.multipliers(y).head(c.nodes()) == reference.normal);
}

TEST_CASE("a node that never meets its obstacle carries nothing") {
  auto const scene = fem::make_steel_brick({.k = 1});
  auto c = test::contact_data(scene);
  c.d[1] = std::numeric_limits<double>::infinity();
  contact::primal_dual const problem(contact::friction_disc{}, scene.K, c);
  auto const G = problem.function(1e4);
  auto const n = scene.f.size();
  VectorXd y = random_vector(G.cols(), 1);
  VectorXd const v = slant::evaluate(G, y);
  CHECK(v.allFinite());
  CHECK(v[n + 1] == y[n + 1]);
  VectorXd row = VectorXd::Zero(G.cols());
  row[n + 1] = 1;
  CHECK(dense_slant(G, y).row(n + 1).transpose() == row);
}

TEST_CASE("one product with K for a value and its slant; nothing allocates") {
  auto const scene = fem::make_steel_brick({.k = 2});
  auto const c = test::contact_data(scene);
  auto const K = slant::counted(scene.K);
  contact::primal_dual const problem(contact::friction_disc{}, K, c);
  auto const G = problem.function(1e4);
  slanting_support::check_products(G, K, random_vector(G.cols(), 1));
}

TEST_CASE("bad input") {
  auto const scene = fem::make_steel_brick({.k = 1});
  auto const c = test::contact_data(scene);
  contact::primal_dual const problem(contact::friction_disc{}, scene.K, c);
  CHECK(SLANT_COMPLAINT(problem.function(-1)) == "rho: got -1, expected a finite number > 0");
  CHECK_THROWS_AS((contact::primal_dual(contact::friction_line{}, scene.K, c)), slant::bad_input);
  CHECK_THROWS_AS(static_cast<void>(problem.displacement(VectorXd::Zero(3))), slant::bad_input);
}

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
    static_cast<void>(solver.solve(slant_F, f, {1e-12, f.norm()}, dλ, prepared));

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

}  // namespace primal_dual_test
