// SPDX-License-Identifier: MIT
#include <oracle/random_programs.hpp>

#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>

#include <support/program_sets.hpp>

namespace random_programs_test {

using Eigen::VectorXd;
using oracle::program_suite;

TEST_CASE("the same number is the same program, another number another one") {
  auto const p = oracle::make_program(program_suite::nasty, 17);
  auto const q = oracle::make_program(program_suite::nasty, 17);
  CHECK(p.A == q.A);
  CHECK(p.b == q.b);
  CHECK(oracle::make_program(program_suite::nasty, 18).b(0) != p.b(0));
}

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
      if (p.planted.size() > 0) {
        CHECK((x - p.planted).norm() <= 1e-14 * p.condition * (1 + p.planted.norm()));
      }
    }
    CHECK(missing <= definite / 10);
  }
}

TEST_CASE("its projections are those of the library, its spectrum what was asked for") {
  for (std::uint64_t k = 0; k < 100; ++k) {
    CAPTURE(k);
    auto p = oracle::make_program(program_suite::nasty, k);
    // With A = I and b = z the reference solution is P(z), and z − P(z) has no error in it.
    VectorXd const z = p.b;
    p.A = Eigen::MatrixXd::Identity(p.size(), p.size());
    VectorXd x(p.size());
    slant::project(test::set_of(p), z, x);
    CHECK(oracle::floors_above(p, x) <= 20);
  }
  oracle::program_shape const shape{.half_lines = 3, .free_unknowns = 6, .condition = 1e6};
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> const eigen(oracle::make_program(shape, 3).A);
  CHECK(eigen.eigenvalues()(8) == doctest::Approx(1));
  CHECK(eigen.eigenvalues()(0) == doctest::Approx(1e-6));
}

TEST_CASE("units change no digit") {
  auto const p = oracle::make_program(program_suite::nasty, 5);
  auto const q = oracle::in_units(p, 300, -200);
  VectorXd x = p.planted;
  x(0) += 1e-3;
  CHECK(oracle::floors_above(q, 0x1p-200 * x) == doctest::Approx(oracle::floors_above(p, x)));
  CHECK(oracle::relative_residual(q, 0x1p-200 * x) ==
        doctest::Approx(oracle::relative_residual(p, x)));
}

}  // namespace random_programs_test
