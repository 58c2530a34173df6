// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <oracle/certificate.hpp>
#include <oracle/dense_newton.hpp>
#include <random>

namespace dense_newton_test {

constexpr double infinity = std::numeric_limits<double>::infinity();

oracle::dense_qp random_qp(unsigned seed, double radius) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  auto const draw = [&] { return normal(random); };
  constexpr Eigen::Index n = 14;
  Eigen::MatrixXd const M = Eigen::MatrixXd::NullaryExpr(n, n + 1, draw);
  oracle::dense_qp qp{M * M.transpose(), {}};
  qp.b = (10 * Eigen::VectorXd::NullaryExpr(n, draw)).cast<oracle::real>();
  for (Eigen::Index i = 0; i < 3; ++i) qp.intervals.push_back({i, -0.1});
  qp.intervals.push_back({3, -0.2, 0.3});
  qp.intervals.push_back({4, -infinity, 0.1});
  for (Eigen::Index i = 5; i < 11; i += 2) qp.circles.push_back({i, i + 1, radius});
  return qp;  // 11, 12 and 13 are free
}

TEST_CASE("random problems with bounds, intervals, circles and free unknowns are solved") {
  for (unsigned seed = 0; seed < 40; ++seed) {
    CAPTURE(seed);
    auto const qp = random_qp(seed, seed % 4 == 0 ? 0.0 : 0.4);
    auto const report = oracle::solve_dense(qp);
    auto const proof = oracle::certify(qp, report.x);
    CHECK(report.residual < 1e-17);
    CHECK(proof.infeasibility < 1e-18);
    CHECK(proof.energy_error < 1e-8);
  }
}

TEST_CASE("the Jacobian is the derivative of the natural residual") {
  auto const qp = random_qp(5, 0.4);
  Eigen::VectorXd const ρ = qp.steps();
  oracle::real_vector const x = oracle::real_vector::LinSpaced(qp.size(), -1, 1);
  oracle::real_vector const direction = oracle::real_vector::LinSpaced(qp.size(), 2, -0.5L);
  oracle::real_vector const z = x - ρ.cast<oracle::real>().cwiseProduct(qp.gradient(x));
  Eigen::MatrixXd const J = ρ.asDiagonal() * oracle::scaled_jacobian(qp, z, ρ);
  oracle::real const h = 1e-7L;
  oracle::real_vector const quotient =
      (qp.natural_residual(x + h * direction, ρ) - qp.natural_residual(x - h * direction, ρ)) /
      (2 * h);
  Eigen::VectorXd const predicted = J * direction.cast<double>();
  CHECK((quotient.cast<double>() - predicted).norm() < 1e-9 * predicted.norm());
}

TEST_CASE("NaN data do not yield a solution") {
  auto qp = random_qp(2, 1);
  qp.b[4] = std::nanl("");
  CHECK_THROWS_AS((void)oracle::solve_dense(qp), std::runtime_error);
  qp.b[4] = 1;
  qp.A(3, 3) = infinity;
  CHECK_THROWS_AS((void)oracle::solve_dense(qp), std::runtime_error);
}

}  // namespace dense_newton_test
