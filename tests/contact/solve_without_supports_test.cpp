// SPDX-License-Identifier: MIT
//
// contact::solve for bodies that no support holds: without a load or without friction, in other
// units, several of them on top of each other.
#include "loose_brick.hpp"

#include <slant/contact/optimality.hpp>
#include <slant/contact/solve.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <fem/stacked_bricks.hpp>
#include <vector>

namespace solve_without_supports_test {

using Eigen::VectorXd;
using slant::status;
namespace contact = slant::contact;
using sparse = Eigen::SparseMatrix<double>;

contact::solution<double> solve(test::loose_brick const& b) {
  contact::solve_options<double> o;
  o.layout = contact::interleaved_layout(b.mesh.nodes);
  return contact::solve(b.K, b.data, o);
}

/// ‖u − exact‖_K/‖exact‖_K.
double distance(sparse const& K, VectorXd const& u, VectorXd const& exact) {
  VectorXd const e = u - exact;
  return std::sqrt(e.dot(K * e) / exact.dot(K * exact));
}

TEST_CASE("contact::solve: a brick without supports and without a load, or without friction") {
  test::loose_brick const idle(0, {0, 0, 0}, 0.05);
  auto const r = solve(idle);
  CAPTURE(r.reason);
  CHECK(r.converged());
  CHECK(r.multipliers.norm() == 0);
  test::loose_brick const smooth(1, {-0.3, 0, 0}, 0, false);
  auto const s = solve(smooth);
  CHECK(s.status == status::unbounded);
  CHECK(s.reason.ends_with("body 0 (unknowns 0 to 107) moves along -x"));
}

TEST_CASE("contact::solve: a brick that friction holds, or not, in other units") {
  for (double const slip : {0.05, 0.01}) {
    test::loose_brick const given(1, {-0.3, 0, 0}, slip);
    auto const one = solve(given);
    for (double const unit : {0x1p-400, 0x1p400}) {
      CAPTURE(unit);
      test::loose_brick brick = given;
      brick.data.f *= unit;
      brick.data.g *= unit;
      brick.K *= unit;
      auto const scaled = solve(brick);
      CAPTURE(scaled.reason);
      CHECK(scaled.status == one.status);
      if (one.converged()) {
        CHECK(distance(given.K, scaled.u, one.u) <=
              1.01 * (scaled.error.relative() + one.error.relative()));
      } else {
        CHECK(scaled.reason == one.reason);
      }
    }
  }
}

TEST_CASE("contact::solve: stacked bricks held by walls and floor, or tipped over") {
  struct push {
    fem::stack_options options;
    bool holds;
  };
  push const pushes[] = {{{.cells = {3, 2, 1}}, true},
                         {{.cells = {3, 2, 1}, .walls = -0.3}, false},
                         {{.cells = {3, 2, 1}, .top = {-1, -1}}, false}};
  for (auto const& [options, holds] : pushes) {
    auto const scene = fem::make_stack(options);
    contact::data<double> const data{scene.B, sparse(0, scene.K.rows()), scene.f, scene.c, {}};
    auto const r = contact::solve(scene.K, data);
    CHECK(r.motions.sentence() ==
          "body 0 (unknowns 0 to 71) has 6 free motions; body 1 (unknowns 72 to 143) has 6 free "
          "motions");
    CAPTURE(r.reason);
    CHECK(r.status == (holds ? status::converged : status::unbounded));
    if (holds) {
      CHECK(contact::check_optimality(scene.K, data, r.u, r.multipliers).residual() <= 1e-6);
      continue;
    }
    CHECK((scene.K * r.descent).norm() <= 1e-12 * scene.K.norm());
    CHECK((scene.B * r.descent).maxCoeff() <= 1e-6);
    CHECK(scene.f.dot(r.descent) >= 1e-3 * scene.f.norm());
  }
}

TEST_CASE("contact::solve: two bricks held by friction, their unknowns in any order") {
  auto const scene = fem::make_stack({.cells = {2, 2, 1}, .walls = 0.1, .top = {1, 1}});
  // Floor and joint with friction, without the walls.
  auto const n = scene.K.rows();
  std::vector<Eigen::Triplet<double>> normal, tangential;
  int m = 0;
  for (std::size_t row = 0; row < scene.axes.size(); ++row) {
    if (scene.axes[row] != 2) continue;
    for (Eigen::Index j = 0; j < n; ++j) {
      double const value = scene.B.coeff(Eigen::Index(row), j);
      if (value == 0) continue;
      normal.emplace_back(m, int(j), value);
      tangential.emplace_back(2 * m, int(j) - 2, value);
      tangential.emplace_back(2 * m + 1, int(j) - 1, value);
    }
    ++m;
  }
  contact::data<double> data{sparse(m, n), sparse(2 * m, n), scene.f, VectorXd::Zero(m),
                             VectorXd::Constant(m, 0.1)};
  data.N.setFromTriplets(normal.begin(), normal.end());
  data.T.setFromTriplets(tangential.begin(), tangential.end());
  auto const r = contact::solve(scene.K, data);
  CAPTURE(r.reason);
  REQUIRE(r.converged());
  CHECK(contact::check_optimality(scene.K, data, r.u, r.multipliers).residual() <= 1e-6);

  Eigen::PermutationMatrix<Eigen::Dynamic> P(n);
  for (Eigen::Index i = 0; i < n; ++i)
    P.indices()[i] = int(i < n / 2 ? 2 * i : 2 * (i - n / 2) + 1);
  contact::data<double> const mixed{sparse(data.N * P.transpose()), sparse(data.T * P.transpose()),
                                    P * data.f, data.d, data.g};
  sparse const K = P * scene.K * P.transpose();
  auto const s = contact::solve(K, mixed);
  CHECK(s.motions.free[1].text == "body 1 (54 of the unknowns 1 to 107) has 6 free motions");
  REQUIRE(s.converged());
  CHECK(contact::check_optimality(K, mixed, s.u, s.multipliers).residual() <= 1e-6);
  CHECK(distance(scene.K, P.transpose() * s.u, r.u) <=
        1.01 * (s.error.relative() + r.error.relative()));
}

}  // namespace solve_without_supports_test
