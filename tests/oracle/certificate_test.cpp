// SPDX-License-Identifier: MIT
#include <fem/steel_brick.hpp>
#include <oracle/certificate.hpp>
#include <oracle/dense_contact_reference.hpp>
#include <oracle/dense_newton.hpp>
#include <oracle/random_programs.hpp>
#include <support/program_sets.hpp>
#include <support/testing.hpp>

namespace certificate_test {

// One bound, one circle, one free unknown, solved by hand:
//   x₀ ≥ 0 with A = 2, b = −4          → x₀ = 0, multiplier 4
//   ‖(x₁, x₂)‖ ≤ 5 with A = I, b = (6, 8) → (3, 4)
//   x₃ free with A = 3, b = 6          → 2
oracle::dense_qp by_hand() {
  oracle::dense_qp qp{Eigen::Vector4d(2, 1, 1, 3).asDiagonal(), {}};
  qp.b = Eigen::Vector4d(-4, 6, 8, 6).cast<oracle::real>();
  qp.intervals.push_back({0, 0.0});
  qp.circles.push_back({1, 2, 5.0});
  return qp;
}

TEST_CASE("certify accepts the solution and bounds the error of other points") {
  auto const qp = by_hand();
  oracle::real_vector const solution = Eigen::Vector4d(0, 3, 4, 2).cast<oracle::real>();
  CHECK(oracle::certify(qp, solution).energy_error < 1e-9);
  CHECK(oracle::certify(qp, solution).infeasibility == 0);

  // Feasible points at many distances: the proven bound is never below the true error.
  for (double const size : {1e-6, 1e-3, 0.1, 1.0}) {
    oracle::real_vector x = solution;
    x[0] += size;
    x[1] -= size;
    x[3] += 2 * size;
    oracle::real_vector const e = x - solution;
    auto const energy = [&](oracle::real_vector const& v) {
      return std::sqrt(v.dot(qp.gradient(v) + qp.b));
    };
    double const error = static_cast<double>(energy(e) / energy(x));
    double const bound = oracle::certify(qp, x).energy_error;
    CHECK(bound >= error);
    // The multiplier 4 of the bound enters the gap to first order, the error only to second.
    CHECK(bound <= 10 * std::sqrt(size));
  }
}

TEST_CASE("certify measures infeasibility") {
  auto const qp = by_hand();
  oracle::real_vector const x = Eigen::Vector4d(-1, 6, 8, 2).cast<oracle::real>();
  CHECK(oracle::certify(qp, x).infeasibility == doctest::Approx(0.5));
}

TEST_CASE("solve_dense finds the solution computed by hand") {
  auto const qp = by_hand();
  auto const x = oracle::solve_dense(qp).x;
  CHECK((x.cast<double>() - Eigen::Vector4d(0, 3, 4, 2)).norm() < 1e-15);
  auto const counts = oracle::count_active(qp, x);
  CHECK(counts.intervals == 1);
  CHECK(counts.circles == 1);
}

using oracle::program_suite;

TEST_CASE("references: solved far below the floor of double, next to what was planted") {
  for (auto suite : {program_suite::nasty, program_suite::degenerate, program_suite::tiny}) {
    int missing = 0, definite = 0;
    for (std::uint64_t k = 0; k < 40; ++k) {
      CAPTURE(k);
      auto const p = oracle::make_program(suite, k);
      REQUIRE(slant::dimension_of(test::set_of(p)) == p.size());
      if (p.planted.size() > 0) CHECK(oracle::floors_above(p, p.planted) <= 20);
      if (!p.definite) continue;
      ++definite;
      auto const exact = oracle::exact_solution(p);
      missing += exact ? 0 : 1;
      if (!exact) continue;
      VectorXd x(p.size());
      for (Eigen::Index i = 0; i < p.size(); ++i) x(i) = double((*exact)[std::size_t(i)]);
      CHECK(oracle::floors_above(p, x) <= 20);
      if (p.planted.size() > 0)
        CHECK((x - p.planted).norm() <= 1e-14 * p.condition * (1 + p.planted.norm()));
    }
    CHECK(missing <= definite / 10);
  }
}

TEST_CASE("the spectrum is what was asked for") {
  oracle::program_shape const shape{.half_lines = 3, .free_unknowns = 6, .condition = 1e6};
  Eigen::SelfAdjointEigenSolver<MatrixXd> const eigen(oracle::make_program(shape, 3).A);
  CHECK(eigen.eigenvalues()(8) == doctest::Approx(1));
  CHECK(eigen.eigenvalues()(0) == doctest::Approx(1e-6));
}

auto solve_brick(int k, fem::brick_load load) {
  auto scene = fem::make_steel_brick({.k = k, .load = load});
  auto reference = oracle::solve_contact({scene.K, scene.N, scene.T, scene.f, scene.d, scene.g});
  return std::pair(std::move(scene), std::move(reference));
}

TEST_CASE("the reference of the brick satisfies the contact conditions and is optimal by duality") {
  auto const check = [](int k, fem::brick_load load) {
    CAPTURE(k);
    CAPTURE(fem::name_of(load));
    auto const [scene, reference] = solve_brick(k, load);
    CHECK(reference.violations.largest() < 1e-15);
    CHECK(reference.proof.infeasibility < 1e-18);
    CHECK(reference.energy_error < 1e-9);
    CHECK(reference.report.residual < 1e-17);
  };
  for (int const k : {1, 2})
    for (fem::brick_load const load : fem::brick_loads) check(k, load);
  check(test::effort(3, 1), fem::brick_load::lift);
}

TEST_CASE("a perturbed displacement violates the conditions") {
  auto const [scene, reference] = solve_brick(1, fem::brick_load::lift);
  oracle::contact_data const data{scene.K, scene.N, scene.T, scene.f, scene.d, scene.g};
  oracle::real_vector const u = reference.u.cast<oracle::real>();
  oracle::real_vector const λ = reference.report.x;
  CHECK(oracle::check_contact(data, u, λ).largest() < 1e-14);
  oracle::real_vector moved = u;
  moved[0] += 1e-3L * u.cwiseAbs().maxCoeff();
  CHECK(oracle::check_contact(data, moved, λ).equilibrium > 1e-6);
  oracle::real_vector adhesive = λ;
  adhesive[0] = -1e-3L * λ.cwiseAbs().maxCoeff();
  CHECK(oracle::check_contact(data, u, adhesive).adhesion == doctest::Approx(1e-3));
  CHECK(oracle::energy_error(scene.K, 1.001 * reference.u, reference.u) == doctest::Approx(1e-3));
}

}  // namespace certificate_test
