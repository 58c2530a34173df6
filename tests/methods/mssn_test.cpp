// SPDX-License-Identifier: MIT
//
// MSSN, IMSSN and GIMSSN: each alone, what they have in common, and plane friction.
#include <slant/contact/dual.hpp>
#include <slant/contact/optimality.hpp>
#include <slant/iteration/iterates.hpp>
#include <slant/slant.hpp>

#include <contact/scenes.hpp>
#include <fem/thesis_ssnm.hpp>
#include <oracle/certificate.hpp>
#include <oracle/dense_newton.hpp>
#include <support/minimise.hpp>
#include <support/testing.hpp>
#include "example_one.hpp"
#include "mixture.hpp"

namespace mssn_test {

using test::mixture;

/// λ^(k+1) of [K (57)–(61)] with dense algebra: discs of radii g at the components (i, i+6).
VectorXd dense_step(test::example_one<double> const& p, VectorXd const& λ, double ρ) {
  MatrixXd const A = p.A;
  VectorXd const z = λ - ρ * (A * λ - p.b);
  VectorXd next = VectorXd::Zero(12);
  std::vector<Eigen::Index> active, frozen;
  for (Eigen::Index i = 0; i < 6; ++i) {
    double const length = std::hypot(z(i), z(i + 6));
    for (auto j : {i, i + 6}) {
      (length <= p.g(i) ? active : frozen).push_back(j);
      if (length > p.g(i)) next(j) = p.g(i) / length * z(j);
    }
  }
  VectorXd const right = (p.b - A * next)(active);
  VectorXd const exact = MatrixXd(A(active, active)).llt().solve(right);
  next(active) = exact;
  return next;
}

TEST_CASE("every step is that of the algorithm, done with dense algebra") {
  test::example_one<double> const p;
  auto const qp = slant::separable_qp{p.a(), p.b, p.set()};
  auto const set = p.set();
  double const ρ = 0.3;
  slant::mssn const method{qp, {.forcing = {.tolerance = 1e-13}, .step_length = ρ}};
  auto s = method.start(p.zero());
  VectorXd λ = p.zero();
  int outside = 0;
  for (int k = 0; k < 12 && s.status == slant::status::running; ++k) {
    CAPTURE(k);
    λ = dense_step(p, λ, ρ);
    method.step(s);
    CHECK((s.x - slant::project(set, λ)).norm() <= 1e-11 * λ.norm());
    outside += s.outside.in_use;
    if (s.outside.in_use) CHECK((s.outside.x - λ).norm() <= 1e-11 * λ.norm());
  }
  CHECK(outside > 0);
  test::example_one_solution<double> const solution;
  CHECK((s.x - solution.x).norm() <= 1e-3 * solution.x.norm());
}

TEST_CASE("the parts combine freely: a projected start, unlimited CG, another forcing rule") {
  test::example_one<double> const p;
  test::example_one_solution<double> const solution;
  auto const qp = slant::separable_qp{p.a(), p.b, p.set()};
  using problem = decltype(qp);
  slant::modified_newton<problem&, slant::projected_start, slant::unlimited_cg,
                         slant::eisenstat_walker> const mixed{qp};
  auto const r = test::minimise(mixed, p.zero(), 1e-12, 100);
  REQUIRE(r.converged());
  CHECK((r.x() - solution.x).norm() <= 1e-10 * solution.x.norm());
  CHECK(r.state.face.count(slant::block_state::free) == 3);  // the discs 1, 4, 6
}

TEST_CASE("the inner accuracy is min(r_tol err/err⁰, c_fact tol), relative to err⁰") {
  test::example_one<double> const p;
  auto const qp = slant::separable_qp{p.a(), p.b, p.set()};
  slant::imssn const method{qp, {.forcing = {.r_tol = 0.1, .c_fact = 0.9}}};
  auto s = method.start(p.zero());
  double const err0 = s.reduced_gradient_norm;
  double tol = 0.1 / 0.9;
  VectorXd φ(12);
  for (int k = 0; k < 8; ++k) {
    tol = std::min(0.1 * (s.reduced_gradient_norm / err0), 0.9 * tol);
    method.step(s);
    CHECK(s.forcing.last_tolerance == doctest::Approx(tol).epsilon(1e-14));
    CHECK(s.last_inner == slant::inner_end::accurate);
    if (s.outside.in_use) continue;
    s.face.keep(s.r, φ);
    CHECK(s.unit * φ.norm() <= tol * err0 * (1 + 1e-14));
  }
}

TEST_CASE("active sets that recur end as stalled, with a reason") {
  auto const wire = fem::make_wire(32);
  auto const set = fem::wire_set(wire, 0, 0.1);
  auto const qp = slant::separable_qp{
      slant::matrix<slant::self_adjoint, slant::positive_definite>(wire.A), wire.b, set};
  VectorXd const zero = VectorXd::Zero(128);
  auto const stop = slant::reduced_gradient_below(1e-8) || slant::at_most(100000);
  auto const r = slant::solve(slant::imssn{qp, {.step_length = 30 * wire.h() / 4, .patience = 50}},
                              zero, stop);
  CHECK(r.status == slant::status::stalled);
  CHECK(r.reason.find("active sets may recur") != std::string::npos);
  CHECK(r.iterations() < 1000);
  // With a smaller parameter the same run converges.
  CHECK(
      slant::solve(slant::imssn{qp, {.step_length = 1.9 * wire.h() / 4}}, zero, stop).converged());
}

double q_of(MatrixXd const& A, VectorXd const& b, VectorXd const& x) {
  return x.dot(0.5 * (A * x) - b);
}

TEST_CASE("the decrease of q of Theorem 7, on both sides of 1/σ_max") {
  test::example_one<double> const p;
  test::example_one_solution<double> const solution;
  auto const qp = slant::separable_qp{p.a(), p.b, p.set()};
  MatrixXd const M = p.A;
  VectorXd const σ = test::eigenvalues_of(M);
  double const σ_min = σ(0), σ_max = σ(11), q_min = q_of(M, p.b, solution.x);
  for (double β : {0.5, 1.0, 1.5, 1.9}) {
    CAPTURE(β);
    double const ρ = β / σ_max, η = 1 - std::min(ρ, 2 / σ_max - ρ) * σ_min;
    double const gap0 = q_of(M, p.b, p.zero()) - q_min;
    double last = gap0;
    int seen = 0;
    for (auto const& s : slant::iterates(slant::gimssn{qp, {.step_length = ρ}}, p.zero())) {
      double const gap = q_of(M, p.b, s.x) - q_min;
      if (!(gap > 1e-13 * gap0)) break;  // rounding errors of q
      if (seen > 0) CHECK(gap <= η * last);
      last = gap;
      ++seen;
    }
    CHECK(seen > 3);
  }
}

TEST_CASE("the parameter of Lemma 7 is insisted on, unless it is given") {
  test::example_one<double> const p;
  auto const qp = slant::separable_qp{p.a(), p.b, p.set()};
  CHECK_THROWS_WITH_AS((slant::gimssn{qp, {.step_factor = 2.0}}),
                       "step_factor: got 2, expected a number in (0, 2)", slant::bad_input);
  slant::gimssn const given{qp, {.step_length = 3.0, .step_factor = 2.0}};
  CHECK(given.start(p.zero()).step_length == 3.0);
  auto const s = slant::gimssn{qp}.start(p.zero());
  double const σ_max = 4 + 2 * std::cos(std::acos(-1.0) / 13);
  CHECK(s.step_length * σ_max == doctest::Approx(1.9));
  CHECK(s.step_length * σ_max < 2);
}

/// f(name, method) for the three of them.
template <class QP, class F>
void for_each_method(QP const& qp, F&& f) {
  f(std::string("mssn"), slant::mssn{qp});
  f(std::string("imssn"), slant::imssn{qp});
  f(std::string("gimssn"), slant::gimssn{qp});
}

TEST_CASE("all kinds of blocks: agreement with Newton's method on dense data") {
  mixture const p(30);
  auto const reference = oracle::solve_dense(p.plain());
  auto const A = slant::counted(test::spd(p.A));
  auto const set = p.set();
  auto const qp = slant::separable_qp{A, p.b, set};
  for_each_method(qp, [&](std::string const& name, auto const& method) {
    CAPTURE(name);
    auto const r = test::minimise(method, VectorXd(VectorXd::Constant(20, 1e6)), 1e-13, 1000);
    REQUIRE(r.converged());
    CHECK((r.x() - reference.x.cast<double>()).norm() <= 1e-10 * r.x().norm());
    VectorXd const x = r.x();
    CHECK(oracle::certify(p.plain(), x.cast<long double>()).energy_error < 1e-6);
  });
}

TEST_CASE("one product for an inner iteration, one for a start, one where λ has left the set") {
  mixture const p(300);
  auto const set = p.set();
  auto const A = slant::counted(test::spd(p.A));
  auto const qp = slant::separable_qp{A, p.b, set};
  for_each_method(qp, [&](std::string const& name, auto const& method) {
    CAPTURE(name);
    auto const before = A.applications();
    auto s = method.start(VectorXd::Zero(20));
    CHECK(A.applications() - before == s.work.setup_applications + 1);  // P_Λ(0) ≠ 0
    slant::index inner = 0, starts = 0, left = 0, total = s.work.operator_applications;
    for (int k = 0; k < 40 && s.status == slant::status::running; ++k) {
      method.step(s);
      inner += s.inner_iterations;
      slant::index const others = s.work.operator_applications - total - s.inner_iterations;
      bool outside = false;
      if constexpr (requires { s.outside.in_use; }) outside = s.outside.in_use;
      left += outside;
      CHECK(others - outside >= 0);
      CHECK(others - outside <= 1);
      starts += others - outside;
      total = s.work.operator_applications;
      // r is that of x, although no product was spent on it.
      VectorXd const r = p.A * s.x - p.b;
      CHECK((s.unit * s.r - r).norm() <= 1e-12 * (r.norm() + p.b.norm()));
      CHECK(set.contains(s.x));
    }
    CHECK(inner > 20);
    CHECK(s.work.inner_iterations == inner);
    CHECK(total == 1 + inner + starts + left);
    CHECK(A.applications() - before == total + s.work.setup_applications);
  });
}

TEST_CASE("a start that keeps λ keeps its gradient as well") {
  // No constraint is felt: nothing is ever frozen, so CG goes on from where it was.
  auto const M = test::with_spectrum(test::log_spaced(20, 100));
  VectorXd const b = test::random_vector(20);
  auto const A = slant::counted(test::spd(M));
  VectorXd const none;
  auto const set = test::mixed_set(none, none, none, 20);
  auto const qp = slant::separable_qp{A, b, set};
  auto const r = test::minimise(slant::imssn{qp}, test::zeros(20), 1e-9, 40);
  REQUIRE(r.converged());
  CHECK((r.x() - VectorXd(M.ldlt().solve(b))).norm() <= 1e-6 * r.x().norm());
  // One more computes r from x before success is claimed.
  CHECK(r.state.work.operator_applications <=
        r.state.work.inner_iterations + 1 + r.state.work.inner_iterations / 50);
}

TEST_CASE("a limit of inner iterations is kept, and does not end the run") {
  mixture const p(300);
  auto const A = slant::counted(test::spd(p.A));
  auto const set = p.set();
  auto const qp = slant::separable_qp{A, p.b, set};
  auto const r = test::minimise(slant::gimssn{qp, {.max_inner = 2}}, test::zeros(20), 1e-8, 5000);
  CHECK(r.converged());
  CHECK(r.state.work.inner_iterations <= 2 * r.iterations());
}

TEST_CASE("a face without a minimum: IMSSN breaks down, GIMSSN goes to the boundary") {
  auto const A = slant::declare<slant::self_adjoint, slant::positive_semidefinite>(
      slant::diagonal(VectorXd{{1.0, 0.0}}));
  VectorXd const b{{1.0, 1.0}}, zero = VectorXd::Zero(2);
  auto const set = slant::intervals(VectorXd{{5.0, 5.0}});
  auto const stop = slant::reduced_gradient_below(1e-10) || slant::at_most(100);
  auto const qp = slant::separable_qp{A, b, set};
  auto const i = slant::solve(slant::imssn{qp, {.step_length = 1.9}}, zero, stop);
  CHECK(i.status == slant::status::breakdown);
  CHECK(i.x().allFinite());
  auto const g = slant::solve(slant::gimssn{qp, {.step_length = 1.9}}, zero, stop);
  REQUIRE(g.converged());
  CHECK(g.x()(0) == doctest::Approx(1));
  CHECK(g.x()(1) == 5.0);
}

TEST_CASE("plane friction: all reach the independent reference, with few products") {
  auto const scene = fem::make_steel_brick({.k = 2, .load = fem::brick_load::pull});
  auto const data = test::one_tangent(scene);
  auto const reference = test::reference(scene.K, data);
  slant::contact::dual const dual(slant::contact::friction_line{}, slant::factorize(scene.K), data);
  auto const qp = dual.qp();
  auto const check = [&](std::string const& name, auto const& method, slant::index products) {
    CAPTURE(name);
    auto const r = test::minimise(method, dual.zero(), 1e-9, 2000);
    REQUIRE(r.converged());
    auto const u = dual.displacement(r.x());
    CHECK(oracle::energy_error(scene.K, u, reference.u) <= 1e-6);
    CHECK(slant::contact::check_optimality(scene.K, data, u, r.x()).residual() <= 1e-7);
    CHECK(r.state.work.operator_applications <= products);
    return r.iterations();
  };
  // On intervals there is no curvature to lose: MSSN is semismooth Newton and ends in few steps.
  CHECK(check("mssn", slant::mssn{qp}, 200) <= 10);
  check("imssn", slant::imssn{qp}, 100);
  check("gimssn", slant::gimssn{qp}, 120);
  check("as_s", slant::as_s(qp), 65);
  check("as", slant::kprgp{qp}, 55);
  check("qpq", slant::qpq{qp}, 55);
}

// [K Ex 5, Table 5]: α̃ = ρ = β/σ_max with β far beyond 2 needs fewer products; AS then oscillates
// where AS-S has been stabilised.
TEST_CASE("steps beyond 2/σ_max: AS oscillates, AS-S and IMSSN converge") {
  auto const scene = fem::make_steel_brick({.k = 2, .load = fem::brick_load::lift});
  auto const data = test::one_tangent(scene);
  slant::contact::dual const dual(slant::contact::friction_line{}, slant::factorize(scene.K), data);
  auto const qp = dual.qp();
  auto const stop = slant::reduced_gradient_below(1e-6) || slant::at_most_applications(1000);
  double const safe = slant::gimssn{qp}.start(dual.zero()).step_length;  // 1.9/σ_max
  for (double β : {8.0, 15.0, 20.0}) {
    CAPTURE(β);
    double const α = β / 1.9 * safe;
    auto const stable = slant::solve(slant::as_s(qp, {.step_length = α}), dual.zero(), stop);
    REQUIRE(stable.converged());
    CHECK(stable.state.work.operator_applications <= 40);
    auto const i = slant::solve(slant::imssn{qp, {.step_length = α}}, dual.zero(), stop);
    CHECK(i.converged());
    CHECK((i.x() - stable.x()).norm() <= 1e-4 * i.x().norm());
    CHECK_FALSE(slant::solve(slant::kprgp{qp, {.step_length = α}}, dual.zero(), stop).converged());
  }
}

}  // namespace mssn_test
