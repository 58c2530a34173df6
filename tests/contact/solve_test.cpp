// SPDX-License-Identifier: MIT
#include "scenes.hpp"

#include <slant/contact/solve.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <random>

namespace solve_test {

using Eigen::VectorXd;
namespace contact = slant::contact;

double true_error(Eigen::SparseMatrix<double> const& K, VectorXd const& u, VectorXd const& exact) {
  VectorXd const e = u - exact;
  return std::sqrt(e.dot(K * e) / exact.dot(K * exact));
}

contact::solution<double> solve(Eigen::SparseMatrix<double> const& K,
                                contact::data<double> const& c,
                                contact::solve_options<double> const& o = {}) {
  return contact::solve(contact::friction_disc{}, K, c, o);
}

TEST_CASE(
    "contact::solve: what it says of its error is true, on sound bodies and on slender ones") {
  struct body {
    Eigen::Vector3d size;
    double least;  // accuracy that must be reached
  };
  for (body const& b : {body{{3, 1, 1}, 1e-8}, body{{300, 1, 1}, 1e-8}, body{{3, 1, 1e-2}, 1e-8},
                        body{{3, 1, 1e-4}, 1e-4}}) {
    for (auto const load : fem::brick_loads) {
      // The reference, which factors A, solves the slender brick under one load only.
      if (b.size.x() > 3 && load != fem::brick_load::lift) continue;
      auto const scene = fem::make_steel_brick({.k = 1, .load = load, .size = b.size});
      auto const data = test::contact_data(scene);
      auto const reference = test::reference(scene.K, data);
      auto const r = solve(scene.K, data);
      CAPTURE(b.size.transpose());
      double const error = true_error(scene.K, r.u, reference.u);
      double const slack = 2 * reference.energy_error;
      CHECK(error <= r.error.relative() + slack);
      CHECK(error <= b.least + slack);
      CHECK((r.converged() || r.status == slant::status::stalled));
      if (b.least <= 1e-8) CHECK(r.converged());
      CHECK(r.converged() == (r.error.relative() <= 1e-8));
      CHECK(r.reason.find("relative energy error") != std::string::npos);
      CHECK(r.multipliers.size() == 3 * data.nodes());
    }
  }
}

TEST_CASE("contact::solve: a sound scene costs one certificate and is not scaled") {
  auto const scene = fem::make_steel_brick({.k = 2, .load = fem::brick_load::lift});
  auto const data = test::contact_data(scene);
  int states = 0;
  auto const r =
      contact::solve(contact::friction_disc{}, scene.K, data, {}, [&](auto const&) { ++states; });
  CHECK(r.converged());
  CHECK(r.corrections == 0);
  CHECK(r.solves == 2);  // for u, and for its residual
  CHECK(r.work.factorizations == 1);
  CHECK_FALSE(r.scaled);
  CHECK(states == r.iterations + 1);
  CHECK(r.condition > 100);
  CHECK(r.condition < 1e6);

  auto const proven = solve(scene.K, data, {.tolerance = 1e-6, .prove = true});
  CHECK(proven.converged());
  CHECK(proven.error.proven);
  CHECK(proven.work.factorizations == 2);
}

TEST_CASE("contact::solve: rows of N and T scaled over sixteen orders of magnitude") {
  auto const scene = fem::make_steel_brick({.k = 2, .load = fem::brick_load::pull});
  auto const data = test::contact_data(scene);
  auto const reference = test::reference(scene.K, data);
  auto other = data;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> exponent(-27, 27);
  VectorXd rows(data.nodes()), pairs(2 * data.nodes());
  for (slant::index i = 0; i < data.nodes(); ++i) {
    rows(i) = std::exp2(exponent(random));
    pairs.segment<2>(2 * i).setConstant(std::exp2(exponent(random)));
    other.d(i) *= rows(i);
    other.g(i) /= pairs(2 * i);
  }
  other.N = Eigen::SparseMatrix<double>(rows.asDiagonal() * data.N);
  other.T = Eigen::SparseMatrix<double>(pairs.asDiagonal() * data.T);
  auto const r = solve(scene.K, other);
  CHECK(r.converged());
  CHECK(r.scaled);
  CHECK(true_error(scene.K, r.u, reference.u) <= 1e-8);
  CHECK(r.iterations <= 60);
}

TEST_CASE("contact::solve: stiffness contrast of twelve orders of magnitude") {
  auto const scene = fem::make_steel_brick({.k = 2, .load = fem::brick_load::lift});
  auto data = test::contact_data(scene);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> exponent(-6, 6);
  VectorXd s(scene.K.rows() / 3);
  for (double& entry : s) entry = std::pow(10, exponent(random) / 2);
  VectorXd scale(scene.K.rows());
  for (slant::index i = 0; i < scale.size(); ++i) scale(i) = s(i / 3);
  // D K D: a body whose nodes differ in stiffness by up to 1e12.
  Eigen::SparseMatrix<double> const half = scale.asDiagonal() * scene.K;
  Eigen::SparseMatrix<double> const K = half * scale.asDiagonal();
  auto const reference = test::reference(K, data);
  auto const r = solve(K, data);
  double const error = true_error(K, r.u, reference.u), slack = 2 * reference.energy_error;
  CHECK(error <= r.error.relative() + slack);
  CHECK(error <= 1e-6);
}

TEST_CASE("contact::solve: tolerance 0 goes on to the last digits and says that they are") {
  auto const scene = fem::make_steel_brick({.k = 1, .load = fem::brick_load::lift});
  auto const data = test::contact_data(scene);
  auto const reference = test::reference(scene.K, data);
  auto const r = solve(scene.K, data, {.tolerance = 0});
  CHECK(r.status == slant::status::stalled);
  CHECK(r.reason.find("rounding errors allow no more") != std::string::npos);
  CHECK(r.error.relative() <= 1e-12);
  CHECK(true_error(scene.K, r.u, reference.u) <= r.error.relative() + 2 * reference.energy_error);
}

TEST_CASE("contact::solve: limits, starts, bad input") {
  auto const scene = fem::make_steel_brick({.k = 1, .load = fem::brick_load::press});
  auto const data = test::contact_data(scene);
  auto const early = solve(scene.K, data, {.max_steps = 1});
  CHECK(early.status == slant::status::iteration_limit);
  CHECK(early.iterations == 1);
  CHECK(early.u.allFinite());
  auto const done = solve(scene.K, data);
  contact::solve_options<double> again;
  again.start = done.multipliers;
  auto const warm = solve(scene.K, data, again);
  CHECK(warm.converged());
  CHECK(warm.iterations <= 2);
  again.start = VectorXd::Zero(2);
  CHECK_THROWS_AS((void)solve(scene.K, data, again), slant::bad_input);
  CHECK_THROWS_AS((void)solve(scene.K, data, {.tolerance = 1}), slant::bad_input);
  CHECK_THROWS_AS((void)solve(scene.K, data, {.max_steps = -1}), slant::bad_input);
  CHECK_THROWS_AS((void)contact::solve(contact::frictionless{}, scene.K, data), slant::bad_input);
  auto far = data;
  far.d.setConstant(-1);
  far.N.setZero();
  CHECK_THROWS_AS((void)solve(scene.K, far), slant::bad_input);
}

}  // namespace solve_test
