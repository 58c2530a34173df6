// SPDX-License-Identifier: MIT
#include <slant/methods/schur_contact.hpp>

#include <slant/contact/bodies.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/operators/counted.hpp>
#include <slant/testing/archetypes/linear_operator.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <oracle/small_polyhedra.hpp>
#include <string>
#include <vector>

#include "support/allocation_guard.hpp"

namespace schur_contact_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using sparse = Eigen::SparseMatrix<double>;
namespace archetype = slant::testing::archetype;
using slant::status;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// A row of springs between n points, free at both ends.
MatrixXd chain(int n, double stiffness = 1) {
  MatrixXd k = MatrixXd::Zero(n, n);
  for (int i = 0; i + 1 < n; ++i) {
    k(i, i) += stiffness;
    k(i + 1, i + 1) += stiffness;
    k(i, i + 1) -= stiffness;
    k(i + 1, i) -= stiffness;
  }
  return k;
}
/// diag(a, b).
MatrixXd both(MatrixXd const& a, MatrixXd const& b) {
  MatrixXd k = MatrixXd::Zero(a.rows() + b.rows(), a.rows() + b.rows());
  k.topLeftCorner(a.rows(), a.rows()) = a;
  k.bottomRightCorner(b.rows(), b.rows()) = b;
  return k;
}

struct small_problem {
  MatrixXd K;
  VectorXd f;
  MatrixXd B;
  VectorXd c;
};

template <class Check>
void solve(small_problem const& p, slant::schur_contact_options<double> const& options,
           Check check) {
  slant::contact::bodies const bodies(sparse(p.K.sparseView()), p.f, sparse(p.B.sparseView()), p.c);
  auto const qp = bodies.qp();
  auto const r = slant::solve(slant::schur_contact{qp, options}, bodies.zero(),
                              slant::residual_below(1e-12) || slant::at_most(500));
  check(bodies, r);
}

/// Solves and compares with every active set.
void compare(small_problem const& p, slant::schur_contact_options<double> const& options = {}) {
  auto const reference = oracle::minimum_over_polyhedron(p.K, p.f, p.B, p.c);
  solve(p, options, [&](auto const& bodies, auto const& r) {
    CAPTURE(r.reason);
    if (!reference) {
      REQUIRE(r.status == status::unbounded);
      VectorXd const d = bodies.direction(r.state.descent).normalized();
      CHECK((p.K * d).norm() <= 1e-13 * p.K.norm());
      CHECK((p.B * d).maxCoeff() <= 1e-13);
      CHECK(p.f.dot(d) > 1e-12 * p.f.norm());
      return;
    }
    REQUIRE(r.converged());
    VectorXd const u = bodies.displacement(r.x());
    VectorXd const λ = r.state.multipliers();
    double const size = p.f.norm();
    CHECK((p.K * u + p.B.transpose() * λ - p.f).norm() <= 1e-11 * size);
    CHECK(λ.minCoeff() >= 0);
    VectorXd const acting = (p.c.array() < infinity).select(VectorXd(p.B * u - p.c), -1.0);
    CHECK(acting.maxCoeff() <= 1e-13 * (u.norm() + 1));
    // The energy is unique even where u is not.
    auto const energy = [&](VectorXd const& v) { return 0.5 * v.dot(p.K * v) - p.f.dot(v); };
    CHECK(std::abs(energy(u) - energy(reference->u)) <= 1e-9 * (std::abs(energy(u)) + size));
  });
}

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
  solve(p, {}, [&](auto const& bodies, auto const& r) {
    REQUIRE(r.converged());
    VectorXd const exact = k.llt().solve(f);
    CHECK((bodies.displacement(r.x()) - exact).norm() <= 1e-13 * exact.norm());
    CHECK(r.iterations() <= 1);  // one unknown is not inside
    CHECK(r.state.multipliers().norm() == 0);
    CHECK(bodies.idle() == 1);
    CHECK(bodies.factorizations() == 2);
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
  solve(p, {}, [&](auto const& bodies, auto const& r) {
    CHECK(r.converged());
    CHECK(bodies.displacement(r.x())[2] == doctest::Approx(1));
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
    solve(p, {.release = 0, .projected_trials = 0}, [&](auto const&, auto const& r) {
      CHECK(r.converged());
      // Each face of the corner at most once.
      CHECK(r.state.releases <= 8);
      CHECK(r.iterations() <= 20);
    });
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
  CHECK_THROWS_WITH_AS(solve(p, {}, [](auto const&, auto const&) {}),
                       "c: got bounds that exclude each other, expected a u with B u <= c",
                       slant::bad_input);
  // Pulled away from the wall.
  compare({chain(3), VectorXd{{-1, 0, 0.5}}, MatrixXd(VectorXd::Unit(3, 0).transpose()),
           VectorXd{{0}}});
  // No load, no constraint that acts: zero is a solution.
  small_problem const idle{chain(3), VectorXd::Zero(3), MatrixXd(VectorXd::Unit(3, 0).transpose()),
                           VectorXd{{infinity}}};
  solve(idle, {}, [](auto const&, auto const& r) {
    CHECK(r.status == status::converged);
    CHECK(r.iterations() == 0);
    CHECK(r.x().norm() == 0);
  });
}

TEST_CASE("the same in other units, bit for bit in the steps") {
  small_problem p{both(chain(4), chain(4)), VectorXd(8), MatrixXd::Zero(3, 8),
                  VectorXd{{0.5, 1, 0}}};
  p.f << 0, 1, 0, 2, 0, 0, -1, 1;
  p.B(0, 3) = 1;
  p.B(0, 4) = -1;
  p.B(1, 7) = 1;
  p.B(2, 0) = -1;
  std::vector<slant::index> steps;
  VectorXd first;
  for (int const e : {0, 480, -480}) {
    small_problem q = p;
    double const force = std::ldexp(1.0, e);
    q.K *= std::ldexp(1.0, e / 2);
    q.f *= force;
    q.c *= std::ldexp(1.0, e - e / 2);
    solve(q, {}, [&](auto const& bodies, auto const& r) {
      REQUIRE(r.converged());
      steps.push_back(r.iterations());
      VectorXd const u = bodies.displacement(r.x()) * std::ldexp(1.0, e / 2 - e);
      if (first.size() == 0) first = u;
      CHECK(u == first);
    });
  }
  CHECK(steps[1] == steps[0]);
  CHECK(steps[2] == steps[0]);
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
  slant::contact::bodies const bodies(sparse(p.K.sparseView()), p.f, sparse(p.B.sparseView()), p.c);
  auto const qp = bodies.qp();
  auto const K = slant::counted(qp.k());
  auto const counted = slant::polyhedral_qp{K, qp.f(), qp.rows(), qp.projection()};
  slant::schur_contact const method{counted};
  auto s = method.start(bodies.zero());
  CHECK(K.applications() == s.work.operator_applications);
  auto copy = s;
  slant::testing::allocation_guard guard;
  for (int i = 0; i < 30; ++i) method.step(s);
  method.refresh(s);
  auto const allocations = guard.count();
  CHECK(allocations == 0);
  CHECK(K.applications() == s.work.operator_applications);
  CHECK(s.status != status::breakdown);
  CHECK(s.residual_norm <= 1e-13 * s.residual_scale);
  for (int i = 0; i < 30; ++i) method.step(copy);
  method.refresh(copy);
  CHECK(copy.x == s.x);
  CHECK(!method.refresh(s));
}

/// A stiffness that gives numbers for so many applications only.
struct wearing_out {
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::positive_semidefinite>;
  MatrixXd k;
  std::shared_ptr<int> left;
  [[nodiscard]] Eigen::Index rows() const { return k.rows(); }
  [[nodiscard]] Eigen::Index cols() const { return k.cols(); }
  void apply(VectorXd const& x, VectorXd& y) const {
    y.noalias() = k * x;
    if (--*left < 0) y[0] = std::numeric_limits<double>::quiet_NaN();
  }
  void diagonal(VectorXd& d) const { d = k.diagonal(); }
};

TEST_CASE("numbers that leave the range are a breakdown") {
  MatrixXd const k = both(chain(5), chain(5)) + MatrixXd::Identity(10, 10);
  VectorXd const f = VectorXd::LinSpaced(10, -1, 2);
  sparse const B = MatrixXd(MatrixXd::Identity(10, 10).rightCols(6).transpose()).sparseView();
  slant::contact::bodies const bodies(sparse(k.sparseView()), f, B, VectorXd::Constant(6, 0.1));
  auto const qp = bodies.qp();
  auto const left = std::make_shared<int>(1000);
  auto const problem =
      slant::polyhedral_qp{wearing_out{k, left}, qp.f(), qp.rows(), qp.projection()};
  auto const run = [&](int applications) {
    *left = applications;
    return slant::solve(slant::schur_contact{problem}, bodies.zero(),
                        slant::residual_below(1e-12) || slant::at_most(100));
  };
  auto const whole = run(1000);
  REQUIRE(whole.converged());
  for (int n = 2; n < whole.state.work.operator_applications; ++n) {
    CAPTURE(n);
    CHECK(run(n).status == status::breakdown);
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
  archetype::vector const load(f), zero(VectorXd(VectorXd::Zero(3)));
  auto const r = slant::solve(slant::schur_contact{slant::polyhedral_qp{K, load, rows, injected{}}},
                              zero, slant::residual_below(1e-13) || slant::at_most(20));
  REQUIRE(r.converged());
  auto const reference = oracle::minimum_over_polyhedron(k, f, b, c);
  CHECK((r.x().local() - reference->u).norm() <= 1e-12);
}

TEST_CASE("what does not fit is named") {
  auto const message = [](auto f) -> std::string {
    try {
      f();
    } catch (slant::bad_input const& e) {
      return e.what();
    }
    return "nothing thrown";
  };
  MatrixXd const k = chain(3) + MatrixXd::Identity(3, 3);
  sparse const K = k.sparseView();
  VectorXd const f = VectorXd::Ones(3);
  sparse const B = MatrixXd{{1, 0, 0}}.sparseView();
  slant::contact::bodies const bodies(K, f, B, VectorXd{{1}});
  auto const qp = bodies.qp();
  CHECK(message([&] {
          (void)slant::schur_contact{qp, {.release = -1}};
        }) == "release: got -1, expected a number >= 0");
  CHECK(message([&] {
          (void)slant::schur_contact{qp, {.projected_trials = -1}};
        }) == "projected_trials: got -1, expected a number >= 0");
  CHECK(message([&] {
          (void)slant::schur_contact{qp, {.patience = -2}};
        }) == "patience: got -2, expected a number >= 0");
  CHECK(message([&] { (void)slant::schur_contact{qp}.start(VectorXd(2)); }) ==
        "u0: got 2, expected the size of f, 3");
  // A projector that moves a contact row.
  sparse u(3, 1);
  u.insert(0, 0) = 1;
  auto const Q = slant::conjugate_projector(K, u);
  auto const wrong = slant::polyhedral_qp{qp.k(), qp.f(), qp.rows(), Q};
  CHECK(message([&] { (void)slant::schur_contact{wrong}.start(bodies.zero()); }) ==
        "projector: got one that moves row 0 of B, expected that of a U with B U = 0");
}

}  // namespace schur_contact_test
