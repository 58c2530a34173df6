// SPDX-License-Identifier: MIT
#include <slant/testing/archetypes.hpp>

#include <support/testing.hpp>
#include <support/two_processes.hpp>
#include "schur_contact_scenes.hpp"

namespace schur_contact_test {

using namespace test::evaluated;
using namespace schur_contact_scenes;
namespace archetype = slant::testing::archetype;

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
    for (int i = 0; i < m; ++i)
      for (int const j : {0, 2, 3, 6}) p.B(i, j) = std::rand() % 3 - 1;
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

TEST_CASE("a corner where more rows are tight than there are directions: no cycling") {
  // Eight walls through one point of the plane; the load presses into their corner or out of it.
  for (int const turn : {0, 1, 2, 3, 5, 7}) {
    small_problem p{MatrixXd::Zero(3, 3), VectorXd::Zero(3), MatrixXd::Zero(8, 3),
                    VectorXd::Zero(8)};
    p.K = chain(3) + MatrixXd(Vector3d(0.1, 0, 0.1).asDiagonal());
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

/// The last of four points against the first of four others, walls at both ends.
small_problem two_chains() {
  return {both(chain(4), chain(4)), VectorXd{{0, 1, 0, 2, 0, 0, -1, 1}},
          MatrixXd{{0, 0, 0, 1, -1, 0, 0, 0}, {0, 0, 0, 0, 0, 0, 0, 1}, {-1, 0, 0, 0, 0, 0, 0, 0}},
          VectorXd{{0.5, 1, 0}}};
}

TEST_CASE("the same in other units, bit for bit in the steps") {
  small_problem const p = two_chains();
  std::vector<slant::index> steps;
  VectorXd first;
  for (int const e : {0, 480, -480}) {
    small_problem q = p;
    double const force = std::ldexp(1.0, e);
    q.K *= std::ldexp(1.0, e / 2);
    q.f *= force;
    q.c *= std::ldexp(1.0, e - e / 2);
    solve(q, {}, [&](body_list const&, report_type const& r) {
      REQUIRE(r.converged());
      steps.push_back(r.iterations());
      VectorXd const u = r.x() * std::ldexp(1.0, e / 2 - e);
      if (first.size() == 0) first = u;
      CHECK(u == first);
    });
  }
  CHECK(steps[1] == steps[0]);
  CHECK(steps[2] == steps[0]);
}

TEST_CASE("rows of any size: the same displacements, multipliers in the units of the rows") {
  small_problem const p = two_chains();
  VectorXd u, λ;
  solve(p, {}, [&](body_list const&, report_type const& r) {
    u = r.x();
    λ = r.state.multipliers();
  });
  REQUIRE(λ.maxCoeff() > 0);
  for (auto const& exponents : {std::array{500, 500, 500}, std::array{-500, -500, -500},
                                std::array{-560, 530, 3}, std::array{900, -900, 0}}) {
    small_problem q = p;
    VectorXd forces = λ;
    for (int i = 0; i < 3; ++i) {
      double const unit = std::ldexp(1.0, exponents[std::size_t(i)]);
      q.B.row(i) *= unit;
      q.c[i] *= unit;
      forces[i] /= unit;
    }
    solve(q, {}, [&](body_list const&, report_type const& r) {
      REQUIRE(r.converged());
      CHECK(r.x() == u);
      CHECK(r.state.multipliers() == forces);
    });
  }
}

TEST_CASE("a start far away is forgotten") {
  small_problem const p{chain(3) + MatrixXd::Identity(3, 3), VectorXd{{3, 0, 1}},
                        MatrixXd{{1, 0, 0}, {0, 0, 1}}, VectorXd{{0.5, 0.3}}};
  auto const reference = oracle::minimum_over_polyhedron(p.K, p.f, p.B, p.c);
  body_list const bodies = body_list{p};
  auto const qp = bodies.qp();
  stiffness const K{p.K};
  for (double const far : {0.0, 1e8, 1e12, 1e14, 1e16, 1e40}) {
    for (double const side : {-1.0, 1.0}) {
      CAPTURE(side * far);
      auto const r = minimise(problem(K, qp.f(), qp.rows(), qp.projection()),
                              VectorXd::Constant(3, side * far));
      CHECK(r.converged());
      CHECK((r.x() - reference->u).norm() <= 1e-12);
      CHECK((p.B * r.x() - p.c).maxCoeff() <= 1e-14);
    }
  }
}

TEST_CASE("vectors that are no Eigen objects") {
  struct injected {  // Q of U = (e₁), by hand
    [[nodiscard]] Eigen::Index rows() const { return 3; }
    [[nodiscard]] Eigen::Index cols() const { return 3; }
    void apply(archetype::vector const& x, archetype::vector& y) const {
      y.local() = x.local();
      y.local()[1] = (x.local()[0] + x.local()[2]) / 2;
    }
    void add_minimiser(double α, archetype::vector const& b, archetype::vector& y,
                       slant::no_workspace&) const {
      y.local()[1] += α * b.local()[1] / 2;
    }
  };
  MatrixXd const k = chain(3);
  MatrixXd const b{{1, 0, 0}, {0, 0, -1}};
  VectorXd const c{{1, 0}}, f{{2, 0, -1}};
  slant::constraint_rows<double> const rows(b.sparseView(), c);
  archetype::psd_operator const K(k);
  archetype::vector const load(f), zero(test::zeros(3));
  auto const r = slant::solve(slant::schur_contact{slant::polyhedral_qp{K, load, rows, injected{}}},
                              zero, slant::residual_below(1e-13) || slant::at_most(20));
  REQUIRE(r.converged());
  auto const reference = oracle::minimum_over_polyhedron(k, f, b, c);
  CHECK((r.x().local() - reference->u).norm() <= 1e-12);

  // The same projector where it moves a row, which nobody can see before it does.
  slant::constraint_rows<double> const moved(MatrixXd{{0, 1, 0}, {0, 0, -1}}.sparseView(), c);
  auto const wrong =
      slant::solve(slant::schur_contact{slant::polyhedral_qp{K, load, moved, injected{}}}, zero,
                   slant::residual_below(1e-13) || slant::at_most(20));
  CHECK(wrong.status == status::breakdown);
  CHECK(wrong.reason == "the projector moves a row of B: it is not that of a U with B U = 0");
}

/// K of one process: no unknown of the one is joined to one of the other.
struct shared_stiffness {
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::positive_definite>;
  MatrixXd k;
  [[nodiscard]] Eigen::Index rows() const { return k.rows(); }
  [[nodiscard]] Eigen::Index cols() const { return k.cols(); }
  void apply(test::shared_vector const& x, test::shared_vector& y) const {
    y.local().noalias() = k * x.local();
  }
};
struct nothing_inside : slant::no_projector {
  using slant::no_projector::no_projector;
};

TEST_CASE("two processes, each with rows of its own") {
  std::srand(4);
  for (int round = 0; round < 6; ++round) {
    MatrixXd const A = MatrixXd::Random(9, 9);
    std::array const blocks{
        MatrixXd(A.topLeftCorner(5, 5).transpose() * A.topLeftCorner(5, 5) +
                 0.1 * MatrixXd::Identity(5, 5)),
        MatrixXd(A.bottomRightCorner(4, 4).transpose() * A.bottomRightCorner(4, 4) +
                 MatrixXd::Identity(4, 4))};
    small_problem p{both(blocks[0], blocks[1]), 4 * VectorXd::Random(9), MatrixXd::Zero(7, 9),
                    VectorXd::Random(7).cwiseAbs()};
    p.B.topLeftCorner(4, 5) = MatrixXd::Random(4, 5);
    p.B.bottomRightCorner(3, 4) = MatrixXd::Random(3, 4);
    p.c.head(4).setZero();  // the first starts in a corner, and has rows to release
    test::two_processes group;
    std::array<VectorXd, 2> u;
    std::array<slant::index, 2> releases{};
    bool const finished = test::two_processes::run([&](int rank) {
      auto const at = std::size_t(rank);
      int const first = 5 * rank, count = 5 - rank;
      MatrixXd const b = p.B.block(4 * rank, first, 4 - rank, count);
      row_set const rows(b.sparseView(), VectorXd(p.c.segment(4 * rank, 4 - rank)));
      shared_stiffness const K{blocks[at]};
      test::shared_vector const f(group, rank, p.f.segment(first, count));
      auto u0 = f;
      u0.local().setZero();
      auto const r = slant::solve(
          slant::schur_contact{slant::polyhedral_qp{K, f, rows, nothing_inside(count)}}, u0,
          slant::residual_below(1e-12) || slant::at_most(300));
      if (!r.converged()) return;
      u[at] = r.x().local();
      releases[at] = r.state.releases;
    });
    REQUIRE(finished);
    REQUIRE(u[0].size() == 5);
    REQUIRE(u[1].size() == 4);
    VectorXd both_parts(9);
    both_parts << u[0], u[1];
    auto const reference = oracle::minimum_over_polyhedron(p.K, p.f, p.B, p.c);
    CHECK((both_parts - reference->u).norm() <= 1e-9 * (1 + reference->u.norm()));
    CHECK(releases[0] == releases[1]);
  }
}

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
  MatrixXd planes(4, 3);
  planes << 2, 1, 0, 1, -2, -2, -1, 0, 0, -2, 0, 2;
  small_problem const corner{chain(3), VectorXd::Zero(3), planes, VectorXd::Zero(4)};
  body_list const bodies{corner};
  auto const from_far = minimise(bodies.qp(), VectorXd{{-6.1, 3.5, -7}}, {});
  CHECK(from_far.converged());
  CHECK(from_far.x().norm() <= 1e-12);
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
      VectorXd const d = Z * Vector2d(std::cos(k * 0.017453), std::sin(k * 0.017453));
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

}  // namespace schur_contact_test
