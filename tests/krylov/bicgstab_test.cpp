// SPDX-License-Identifier: MIT
#include <slant/iteration/solve.hpp>
#include <slant/krylov/bicgstab.hpp>
#include <slant/operators/operators.hpp>

#include <support/testing.hpp>
#include "spd_matrices.hpp"

namespace bicgstab_test {

MatrixXd nonsymmetric(Eigen::Index n, double skewness) {
  MatrixXd m = test::with_spectrum(test::log_spaced(n, 20));
  std::mt19937 generator(7);
  std::normal_distribution<double> gaussian;
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      double const s = skewness * gaussian(generator) / double(n);
      m(i, j) += s;
      m(j, i) -= s;
    }
  }
  return m;
}

TEST_CASE("bicgstab agrees with a dense solve on nonsymmetric systems") {
  for (double skewness : {0.0, 0.5, 2.0}) {
    auto const M = nonsymmetric(40, skewness);
    VectorXd const b = test::random_vector(40);
    VectorXd const exact = M.fullPivLu().solve(b);
    auto const A = slant::matrix(M);
    auto const r = slant::solve(slant::bicgstab{A, b}, test::zeros(40),
                                slant::residual_below(1e-12) || slant::at_most(400));
    REQUIRE(r.converged());
    CHECK((r.x() - exact).norm() <= 1e-9 * exact.norm());
    CHECK((M * r.x() - b).norm() <= 1e-11 * b.norm());
  }
}

TEST_CASE("work is counted: two applications a full step") {
  auto const M = nonsymmetric(40, 1.0);
  auto const inner = slant::matrix(M);
  auto const A = slant::counted(inner);
  VectorXd const b = test::random_vector(40);
  auto const r = slant::solve(slant::bicgstab{A, b}, test::zeros(40), slant::at_most(6));
  CHECK(r.state.work.operator_applications == 12);
  CHECK(A.applications() == 12);
}

TEST_CASE("a right preconditioner changes the work, not the solution") {
  auto M = nonsymmetric(40, 0.5);
  VectorXd scale(40);
  for (int i = 0; i < 40; ++i) scale(i) = std::pow(10.0, (i % 5) - 2);
  M = (scale.asDiagonal() * M).eval();
  VectorXd const b = test::random_vector(40);
  auto const A = slant::matrix(M);
  VectorXd const weights = M.diagonal().cwiseInverse();
  auto const D = slant::diagonal(weights);
  auto const r = slant::solve(slant::bicgstab{A, b, D}, test::zeros(40),
                              slant::residual_below(1e-11) || slant::at_most(200));
  REQUIRE(r.converged());
  VectorXd const exact = M.fullPivLu().solve(b);
  CHECK((r.x() - exact).norm() <= 1e-7 * exact.norm());
}

TEST_CASE("rᵀA r = 0 for all r: a turned shadow residual solves what r̂ = r cannot begin") {
  MatrixXd plane(2, 2);
  plane << 0, 1, -1, 0;
  MatrixXd const M = test::random_vector(400, 5).reshaped(20, 20);
  for (MatrixXd const& skew : {plane, MatrixXd(M - M.transpose())}) {
    auto const n = skew.rows();
    auto const A = slant::matrix(skew);
    VectorXd const b = test::random_vector(n, 6);
    auto const r = slant::solve(slant::bicgstab{A, b}, test::zeros(n),
                                slant::residual_below(1e-8) || slant::at_most(60));
    CAPTURE(n);
    REQUIRE(r.converged());
    CHECK((skew * r.x() - b).norm() <= 1.01e-8 * b.norm());
  }
}

TEST_CASE("a shadow residual that becomes orthogonal is renewed") {
  // Permutation-like matrices make ρ = r̂ᵀr vanish within a few steps.
  MatrixXd M = MatrixXd::Zero(4, 4);
  M << 1, 2, 0, 0,  //
      0, 1, 2, 0,   //
      0, 0, 1, 2,   //
      2, 0, 0, 1;
  VectorXd b(4);
  b << 1, 0, 0, 0;
  auto const A = slant::matrix(M);
  auto const r = slant::solve(slant::bicgstab{A, b}, test::zeros(4),
                              slant::residual_below(1e-10) || slant::at_most(200));
  REQUIRE(r.converged());
  CHECK((M * r.x() - b).norm() <= 1e-9);
}

}  // namespace bicgstab_test
