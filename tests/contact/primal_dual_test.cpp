// SPDX-License-Identifier: MIT
#include "scenes.hpp"

#include <slanting/slanting_support.hpp>

#include <slant/contact/primal_dual.hpp>
#include <slant/operators/counted.hpp>

#include <support/allocation_guard.hpp>

#include <doctest/doctest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

namespace primal_dual_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
namespace contact = slant::contact;
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
      Eigen::Vector2d const e = z / z.norm();
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
  VectorXd const y = random_vector(G.cols(), 1);
  VectorXd v(G.rows()), Gv(G.rows());
  auto w = slant::workspace(G, y);
  auto g = G.slant(problem.zero());
  auto gw = slant::workspace(g, y);
  K.reset_counts();
  slant::testing::allocation_guard const guard;
  slant::evaluate(G, y, v, w);
  slant::update_slant_after_value(G, y, g, w);
  slant::apply(g, v, Gv, gw);
  auto const allocations = guard.count();
  CHECK(K.counts().applications == 2);  // one for the value, one for the product
  CHECK(allocations == 0);
}

TEST_CASE("bad input") {
  auto const scene = fem::make_steel_brick({.k = 1});
  auto const c = test::contact_data(scene);
  contact::primal_dual const problem(contact::friction_disc{}, scene.K, c);
  CHECK_THROWS_WITH_AS(static_cast<void>(problem.function(-1)),
                       "rho: got -1, expected a finite number > 0", slant::bad_input);
  CHECK_THROWS_AS((contact::primal_dual(contact::friction_line{}, scene.K, c)), slant::bad_input);
  CHECK_THROWS_AS(static_cast<void>(problem.displacement(VectorXd::Zero(3))), slant::bad_input);
}

}  // namespace primal_dual_test
