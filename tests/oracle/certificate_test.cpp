// SPDX-License-Identifier: MIT
#include <oracle/certificate.hpp>
#include <oracle/dense_newton.hpp>
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

}  // namespace certificate_test
