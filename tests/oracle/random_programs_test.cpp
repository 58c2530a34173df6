// SPDX-License-Identifier: MIT
#include <oracle/random_programs.hpp>
#include <support/program_sets.hpp>
#include <support/testing.hpp>

namespace random_programs_test {

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
      if (p.planted.size() > 0) {
        CHECK((x - p.planted).norm() <= 1e-14 * p.condition * (1 + p.planted.norm()));
      }
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

}  // namespace random_programs_test
