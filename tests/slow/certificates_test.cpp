// SPDX-License-Identifier: MIT
//
// A hundred thousand certificates of random, degenerate and ill-conditioned programs against
// solutions in quadruple precision: none below the error, and how far above at the end of a run.
#include <slant/slant.hpp>

#include <oracle/random_programs.hpp>
#include <support/minimise.hpp>
#include <support/program_sets.hpp>
#include <support/testing.hpp>

namespace certificates_test {

using long_matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

/// A⁻¹ from the long type, rounded: off by less than ε‖A⁻¹‖ in each entry for κ up to 1e14.
MatrixXd inverse_of(MatrixXd const& A) {
  long_matrix const inverse = A.cast<long double>().eval().inverse();
  return (0.5L * (inverse + inverse.transpose())).cast<double>();
}

TEST_CASE("no certificate is below the error; at the end of a run it is close to it") {
  double const ε = std::numeric_limits<double>::epsilon();
  std::mt19937 random(20261122);
  std::normal_distribution<double> gauss;
  std::uniform_real_distribution<double> uniform(0, 1);
  long certificates = 0, below = 0, programs = 0;
  std::vector<double> ratios;
  for (std::uint64_t seed = 0; programs < 2500 && seed < 5000; ++seed) {
    oracle::program_shape shape;
    shape.half_lines = int(seed % 5);
    shape.intervals = int(seed % 3);
    shape.discs = 1 + int(seed % 4);
    shape.free_unknowns = int(seed % 2);
    shape.condition = std::pow(10, 12 * uniform(random));
    shape.degenerate = seed % 3 == 0 ? 0.5 : 0;
    shape.pinned = seed % 5 == 0 ? 0.3 : 0;
    shape.gap = seed % 2 == 0 ? 1 : 1e4;
    auto const p = oracle::make_program(shape, seed);
    auto const exact = oracle::exact_solution(p);
    if (!exact) continue;
    ++programs;
    VectorXd solution(p.size());
    for (Eigen::Index i = 0; i < p.size(); ++i)
      solution(i) = static_cast<double>((*exact)[static_cast<std::size_t>(i)]);
    double const size = std::sqrt(solution.dot(p.A * solution));
    if (!(size > 0)) continue;
    MatrixXd const inverse = inverse_of(p.A);
    auto const set = test::set_of(p);
    slant::separable_qp const qp{slant::matrix<slant::self_adjoint, slant::positive_definite>(p.A),
                                 p.b, set};
    auto const M = slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(inverse);
    slant::energy_certificate certificate(qp, slant::dominates_inverse(M));
    // What rounding g and the quadratic form may lose.
    double const n = double(p.size());
    double const lost_in_g =
        4 * n * ε * (p.A.norm() * solution.norm() + p.b.norm()) * std::sqrt(inverse.norm());
    double const relative = 4 * n * ε * inverse.norm() * p.A.norm();
    auto const look = [&](VectorXd const& x, bool is_last) {
      VectorXd const y = slant::project(set, x);
      double const error = oracle::energy_error(p, y, *exact) * size;
      auto const e = certificate(x);
      ++certificates;
      if (!(e.bound * (1 + relative) + lost_in_g >= error * (1 - 1e-12))) ++below;
      // On ill-conditioned programs a small reduced gradient is no end of a run.
      if (is_last && shape.condition <= 1e4 && error > 10 * lost_in_g)
        ratios.push_back(e.bound / error);
    };
    for (int k = 0; k < 40; ++k) {
      double const δ = std::pow(10, -15 * uniform(random));
      VectorXd x = solution;
      for (double& entry : x) entry += δ * std::abs(entry) * gauss(random);
      if (k % 2 == 1)
        x += δ * solution.norm() * VectorXd::NullaryExpr(x.size(), [&] { return gauss(random); });
      look(x, false);
    }
    auto const run = test::minimise(slant::symmetric_newton{qp}, test::zeros(p.size()), 1e-9, 500);
    if (run.converged()) look(run.x(), true);
  }
  CHECK(certificates >= 100000);
  CHECK(below == 0);
  std::sort(ratios.begin(), ratios.end());
  REQUIRE(ratios.size() > 50);
  MESSAGE(certificates, " certificates, ", below, " below the error; at the end of ", ratios.size(),
          " runs median ", ratios[ratios.size() / 2], ", 90 % below ",
          ratios[ratios.size() * 9 / 10], ", largest ", ratios.back());
  CHECK(ratios[ratios.size() / 2] <= 3);
}

}  // namespace certificates_test
