// SPDX-License-Identifier: MIT
#include "schur_contact_scenes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "support/allocation_guard.hpp"

namespace schur_contact_test {

using namespace schur_contact_scenes;

TEST_CASE(
    "random problems with floating bodies, dependent rows and ties: as every active set says") {
  std::srand(5);
  int unbounded = 0;
  for (int round = 0; round < 60; ++round) {
    small_problem p;
    p.K = both(chain(4, 1), chain(3, 10));
    if (round % 3 == 0) p.K(0, 0) += 1;
    int const m = 2 + round % 5;
    // Unknowns 1, 4, 5 are inside; small whole numbers make dependent rows and ties likely.
    p.B = MatrixXd::Zero(m, 7);
    for (int i = 0; i < m; ++i) {
      for (int const j : {0, 2, 3, 6}) p.B(i, j) = std::rand() % 3 - 1;
    }
    p.c = VectorXd::Zero(m);
    for (int i = 0; i < m; ++i) p.c[i] = std::rand() % 3;
    p.f = VectorXd::Zero(7);
    for (int j = 0; j < 7; ++j) p.f[j] = std::rand() % 7 - 3;
    if (!oracle::minimum_over_polyhedron(p.K, p.f, p.B, p.c)) ++unbounded;
    CAPTURE(round);
    compare(p);
    compare(p, {.release = 0, .projected_trials = 0});
    compare(p, {.release = 2, .projected_trials = 4});
  }
  CHECK(unbounded > 10);
  CHECK(unbounded < 50);
}

TEST_CASE("without constraints in reach: the solution of a linear system") {
  MatrixXd k = both(chain(5), chain(4));
  k(0, 0) += 1;
  k(8, 8) += 3;
  VectorXd const f = VectorXd::LinSpaced(9, -1, 2);
  MatrixXd b = MatrixXd::Zero(1, 9);
  b(0, 2) = 1;
  small_problem const p{k, f, b, VectorXd{{100}}};
  solve(p, {}, [&](body_list const&, report_type const& r) {
    REQUIRE(r.converged());
    VectorXd const exact = k.llt().solve(f);
    CHECK((r.x() - exact).norm() <= 1e-13 * exact.norm());
    CHECK(r.iterations() <= 1);  // one unknown is not inside
    CHECK(r.state.multipliers().norm() == 0);
  });
}

TEST_CASE("redundant and repeated rows") {
  // A point pushed against the same wall, written four times, one of them at another distance.
  small_problem p{chain(3), VectorXd{{0, 0, 2}}, MatrixXd::Zero(5, 3), VectorXd{{1, 1, 3, 1, 0}}};
  p.B(0, 2) = 1;
  p.B(1, 2) = 1;
  p.B(2, 2) = 3;
  p.B(3, 2) = 0.5;
  p.B(4, 0) = -1;
  compare(p);
  p.c[3] = 0.5;
  compare(p);
  solve(p, {}, [&](body_list const&, report_type const& r) {
    CHECK(r.converged());
    CHECK(r.x()[2] == doctest::Approx(1));
    // Forces of the copies add up to the load.
    CHECK((p.B.transpose() * r.state.multipliers())[2] == doctest::Approx(2));
  });
}

TEST_CASE("a corner where more rows are tight than there are directions: no cycling") {
  // Eight walls through one point of the plane; the load presses into their corner or out of it.
  for (int const turn : {0, 1, 2, 3, 5, 7}) {
    small_problem p{MatrixXd::Zero(3, 3), VectorXd::Zero(3), MatrixXd::Zero(8, 3),
                    VectorXd::Zero(8)};
    p.K = chain(3) + MatrixXd(Eigen::Vector3d(0.1, 0, 0.1).asDiagonal());
    for (int i = 0; i < 8; ++i) {
      p.B(i, 0) = std::cos(0.3 * i);
      p.B(i, 2) = std::sin(0.3 * i);
    }
    p.f << std::cos(0.8 * turn), 0.1, std::sin(0.8 * turn);
    compare(p);
    solve(p, {.release = 0, .projected_trials = 0}, [&](body_list const&, report_type const& r) {
      CHECK(r.converged());
      // Each face of the corner at most once.
      CHECK(r.state.releases <= 8);
      CHECK(r.iterations() <= 20);
    });
  }
}

TEST_CASE("no allocation in a step; states are values; refresh; counts") {
  small_problem p{both(chain(6), chain(6)), VectorXd::Ones(12), MatrixXd::Zero(4, 12),
                  VectorXd{{0.1, 0.3, 0, 2}}};
  p.f[3] = -1;
  p.B(0, 5) = 1;
  p.B(0, 6) = -1;
  p.B(1, 11) = 1;
  p.B(2, 0) = -1;
  p.B(3, 4) = 1;
  body_list const bodies = body_list{p};
  auto const qp = bodies.qp();
  stiffness const& K = qp.k();
  method const steps(qp);
  auto s = steps.start(bodies.zero());
  CHECK(*K.applications == s.work.operator_applications);
  auto copy = s;
  slant::testing::allocation_guard guard;
  for (int i = 0; i < 30; ++i) steps.step(s);
  steps.refresh(s);
  auto const allocations = guard.count();
  CHECK(allocations == 0);
  CHECK(*K.applications == s.work.operator_applications);
  CHECK(s.status != status::breakdown);
  CHECK(s.residual_norm <= 1e-13 * s.residual_scale);
  for (int i = 0; i < 30; ++i) steps.step(copy);
  steps.refresh(copy);
  CHECK(copy.x == s.x);
  CHECK(!steps.refresh(s));
}

TEST_CASE(
    "finite termination: no face comes back, and none takes more steps than it has dimensions") {
  std::srand(2);
  slant::index total = 0;
  for (int round = 0; round < 40; ++round) {
    MatrixXd const A = MatrixXd::Random(9, 9);
    small_problem p{A.transpose() * A + 0.1 * MatrixXd::Identity(9, 9), 5 * VectorXd::Random(9),
                    MatrixXd::Zero(8, 9), VectorXd::Random(8).cwiseAbs()};
    p.B.leftCols(7) = MatrixXd::Random(8, 7);  // two unknowns inside
    if (round % 2 == 0) p.c.setZero();         // all rows meet in one point
    body_list const bodies = body_list{p};
    auto const qp = bodies.qp();
    method const steps(qp, {.release = 0, .projected_trials = 0});
    auto s = steps.start(bodies.zero());
    std::vector<std::vector<bool>> left;
    auto const face = [&] {
      std::vector<bool> J(8);
      for (int i = 0; i < 8; ++i) J[std::size_t(i)] = s.rows.active.contains(i);
      return J;
    };
    slant::index on_face = 0;
    auto before = face();
    while (s.status == status::running && s.residual_norm > 1e-12 * s.residual_scale &&
           s.iteration < 500) {
      auto const releases = s.releases;
      steps.step(s);
      if (s.releases > releases) {
        CHECK(std::count(left.begin(), left.end(), before) == 0);
        left.push_back(before);
      }
      auto const now = face();
      on_face = now == before ? on_face + 1 : 1;
      auto const rank = std::min<slant::index>(7, s.rows.active.size());
      if (now == before) CHECK(on_face <= 7 - rank + 1);
      before = now;
    }
    CAPTURE(round);
    CHECK(s.residual_norm <= 1e-12 * s.residual_scale);
    total += s.releases;
  }
  CHECK(total >= 30);
}

}  // namespace schur_contact_test
