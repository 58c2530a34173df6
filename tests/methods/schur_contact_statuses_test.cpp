// SPDX-License-Identifier: MIT
#include "schur_contact_scenes.hpp"
#include "support/message.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace schur_contact_statuses_test {

using namespace schur_contact_scenes;

TEST_CASE("starts out of the set, sets without points, loads without a state of rest") {
  small_problem p{chain(3), VectorXd{{1, 0, 1}}, MatrixXd::Zero(2, 3), VectorXd{{-1, 4}}};
  p.B(0, 0) = 1;  // u₀ ≤ −1
  p.B(1, 2) = 1;
  compare(p);  // zero violates the first row
  p.B(1, 0) = -1;
  p.B(1, 2) = 0;
  p.c[1] = 0;  // u₀ ≥ 0
  CHECK_THROWS_WITH_AS(solve(p, {}, [](body_list const&, report_type const&) {}),
                       "c: got bounds that exclude each other, expected a u with B u <= c",
                       slant::bad_input);
  // Pulled away from the wall.
  compare({chain(3), VectorXd{{-1, 0, 0.5}}, MatrixXd(VectorXd::Unit(3, 0).transpose()),
           VectorXd{{0}}});
  // No load, no constraint that acts: zero is a solution.
  small_problem const idle{chain(3), VectorXd::Zero(3), MatrixXd(VectorXd::Unit(3, 0).transpose()),
                           VectorXd{{infinity}}};
  solve(idle, {}, [](body_list const&, report_type const& r) {
    CHECK(r.status == status::converged);
    CHECK(r.iterations() == 0);
    CHECK(r.x().norm() == 0);
  });
}

TEST_CASE("numbers that leave the range are a breakdown") {
  small_problem const p{
      both(chain(5), chain(5)) + MatrixXd::Identity(10, 10), VectorXd::LinSpaced(10, -1, 2),
      MatrixXd::Identity(10, 10).rightCols(6).transpose(), VectorXd::Constant(6, 0.1)};
  body_list const bodies = body_list{p};
  auto const qp = bodies.qp();
  auto const run = [&](int applications) {
    stiffness const K{p.K, std::make_shared<int>(0), applications};
    return minimise(problem(K, qp.f(), qp.rows(), qp.projection()), bodies.zero());
  };
  auto const whole = run(1000);
  REQUIRE(whole.converged());
  for (int n = 2; n < whole.state.work.operator_applications; ++n) {
    CAPTURE(n);
    CHECK(run(n).status == status::breakdown);
  }
}

TEST_CASE("what does not fit is named") {
  small_problem const p{chain(3) + MatrixXd::Identity(3, 3), VectorXd{{0, 0, 1}},
                        MatrixXd{{1, 0, 0}}, VectorXd{{0}}};
  stiffness const K{p.K};
  row_set const rows(p.B.sparseView(), p.c);
  auto const started = [&](projector const& Q, options const& o, VectorXd const& u0) {
    return test::complaint([&] {
      auto const qp = problem(K, p.f, rows, Q);
      (void)method(qp, o).start(u0);
    });
  };
  VectorXd const zero = VectorXd::Zero(3);
  projector const good = projector_of(p.K, VectorXd::Unit(3, 1));
  CHECK(started(good, {.release = -1}, zero) == "release: got -1, expected a number >= 0");
  CHECK(started(good, {.projected_trials = -1}, zero) ==
        "projected_trials: got -1, expected a number >= 0");
  CHECK(started(good, {.patience = -2}, zero) == "patience: got -2, expected a number >= 0");
  CHECK(started(good, {}, VectorXd(2)) == "u0: got 2, expected the size of f, 3");
  // A projector that moves a row of B is named, also where the load does not show it.
  CHECK(started(projector_of(p.K, VectorXd::Unit(3, 0)), {}, zero) ==
        "projector: got one that moves row 0 of B, expected that of a U with B U = 0");
}

TEST_CASE("a U that moves no row up to rounding is as good as one that moves none") {
  std::srand(8);
  small_problem p{chain(3) + MatrixXd::Identity(3, 3), VectorXd(3), MatrixXd{{1, 1, 1}},
                  VectorXd{{1}}};
  stiffness const K{p.K};
  row_set const rows(p.B.sparseView(), p.c);
  projector const Q = projector_of(p.K, VectorXd{{0.1, 0.2, -0.3}});
  for (int round = 0; round < 20; ++round) {
    p.f = 3 * VectorXd::Random(3);
    auto const r = minimise(problem(K, p.f, rows, Q), VectorXd::Zero(3));
    REQUIRE(r.converged());
    auto const reference = oracle::minimum_over_polyhedron(p.K, p.f, p.B, p.c);
    CHECK((r.x() - reference->u).norm() <= 1e-11 * p.f.norm());
  }
}

TEST_CASE("no solution, with a soft mode beside the kernel") {
  auto const pair = [](double soft) { return MatrixXd{{1 + soft, -1}, {-1, 1 + soft}}; };
  for (double const soft : {1e-9, 1e-10, 1e-12}) {
    small_problem const p{both(pair(soft), pair(0)), VectorXd{{1, 1, 0.3, 0.3}},
                          -MatrixXd::Identity(4, 4), VectorXd::Constant(4, 1e30)};
    CAPTURE(soft);
    solve(p, {}, [&](body_list const&, report_type const& r) {
      CAPTURE(r.reason);
      REQUIRE(r.status == status::unbounded);
      VectorXd const d = r.state.descent.normalized();
      CHECK((d - VectorXd{{0, 0, 1, 1}} / std::sqrt(2)).norm() <= 1e-7);
      CHECK((p.K * d).norm() <= 1e-14);
    });
  }
  // A kernel of two directions and a soft one, at random angles to each other.
  std::srand(11);
  int unbounded = 0;
  for (int round = 0; round < 60; ++round) {
    MatrixXd A = MatrixXd::Random(6, 8);
    MatrixXd Z = MatrixXd::Random(8, 2);
    Z.col(0).normalize();
    Z.col(1) -= Z.col(0).dot(Z.col(1)) * Z.col(0);
    Z.col(1).normalize();
    A -= A * Z * Z.transpose();
    A.row(0) *= 1e-4;
    small_problem p{A.transpose() * A, VectorXd::Random(8), MatrixXd::Zero(6, 8),
                    VectorXd::Random(6).cwiseAbs()};
    p.B.leftCols(6) = MatrixXd::Random(6, 6);
    // How fast j falls along the kernel at least as fast as it leaves the rows.
    double margin = -1;
    for (int k = 0; k < 360; ++k) {
      VectorXd const d = Z * Eigen::Vector2d(std::cos(k * 0.017453), std::sin(k * 0.017453));
      margin = std::max(margin, std::min(p.f.dot(d), -(p.B * d).maxCoeff()));
    }
    if (margin < 0.02) continue;
    ++unbounded;
    CAPTURE(round);
    solve(p, {}, [&](body_list const&, report_type const& r) {
      CAPTURE(r.reason);
      REQUIRE(r.status == status::unbounded);
      VectorXd const d = r.state.descent.normalized();
      CHECK((p.K * d).norm() <= 1e-12 * p.K.norm());
      CHECK((p.B * d).maxCoeff() <= 1e-10);
      CHECK(p.f.dot(d) > 0);
    });
  }
  CHECK(unbounded >= 5);
}

}  // namespace schur_contact_statuses_test
