// SPDX-License-Identifier: MIT
#include "spd_matrices.hpp"

#include <slant/krylov/spectral_bound.hpp>
#include <slant/operators/counted.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <support/effort.hpp>

namespace spectral_bound_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

TEST_CASE("the bound is never below the largest eigenvalue, and not far above it") {
  int tested = 0;
  for (Eigen::Index n : {1, 2, 5, 40, test::effort(200, 60)}) {
    for (double κ : {1.0, 10.0, 1e4, 1e12}) {
      for (unsigned seed = 1; seed <= 3; ++seed) {
        auto const M = test::with_spectrum(test::log_spaced(n, κ), seed);
        VectorXd const spectrum = Eigen::SelfAdjointEigenSolver<MatrixXd>(M).eigenvalues();
        double const σ = spectrum.maxCoeff();
        auto const A = test::spd(M);
        auto const bound = slant::largest_eigenvalue_bound(A, VectorXd(n), {.seed = seed});
        CHECK(bound.upper >= σ);
        CHECK(bound.upper <= 1.8 * σ);
        CHECK(bound.ritz <= σ * (1 + 1e-12));
        CHECK(bound.smallest_ritz >= spectrum.minCoeff() - 1e-12 * σ);
        CHECK(bound.smallest_ritz <= bound.ritz * (1 + 1e-12));
        if (n <= 5) CHECK(bound.smallest_ritz <= spectrum.minCoeff() + 1e-8 * σ);
        ++tested;
      }
    }
  }
  CHECK(tested == 60);
}

TEST_CASE("a lonely eigenvalue hidden in one direction is found") {
  VectorXd spectrum = VectorXd::Ones(500);
  spectrum(250) = 1e3;
  MatrixXd const M = spectrum.asDiagonal();
  auto const A = test::spd(M);
  CHECK(slant::largest_eigenvalue_bound(A, VectorXd(500)).upper >= 1e3);
}

TEST_CASE("a dense cluster at the top, the worst case for few steps, is bounded too") {
  auto const spectrum = VectorXd::LinSpaced(400, 0.9, 1.0).eval();
  MatrixXd const M = spectrum.asDiagonal();
  auto const A = test::spd(M);
  CHECK(slant::largest_eigenvalue_bound(A, VectorXd(400), {.steps = 5}).upper >= 1.0);
}

TEST_CASE("work: as many products as steps, fewer if the spectrum is small") {
  auto const M = test::with_spectrum(test::log_spaced(100, 100));
  auto const inner = test::spd(M);
  auto const A = slant::counted(inner);
  CHECK(slant::largest_eigenvalue_bound(A, VectorXd(100), {.steps = 40}).applications == 40);
  CHECK(A.applications() == 40);
  // Too few steps for the probability asked for are made up to what it takes.
  auto const few = slant::largest_eigenvalue_bound(inner, VectorXd(100), {.steps = 2}).applications;
  auto const rash =
      slant::largest_eigenvalue_bound(inner, VectorXd(100), {.steps = 2, .failure = 0.01});
  CHECK(few > 10);
  CHECK(rash.applications < few);
  MatrixXd const I = 3 * MatrixXd::Identity(50, 50);
  auto const S = test::spd(I);
  auto const exact = slant::largest_eigenvalue_bound(S, VectorXd(50));
  CHECK(exact.applications <= 2);
  CHECK(exact.upper == doctest::Approx(3).epsilon(1e-12));
}

TEST_CASE("scales from 1e-150 to 1e150, bit for bit under powers of two") {
  auto const M = test::with_spectrum(test::log_spaced(60, 100));
  auto const A = test::spd(M);
  double const σ = slant::largest_eigenvalue_bound(A, VectorXd(60)).upper;
  for (int e : {-498, -40, 40, 498}) {
    MatrixXd const scaled = std::ldexp(1.0, e) * M;
    auto const B = test::spd(scaled);
    CHECK(slant::largest_eigenvalue_bound(B, VectorXd(60)).upper == std::ldexp(σ, e));
  }
}

TEST_CASE("zero operator, no unknowns, broken operators") {
  MatrixXd const Z = MatrixXd::Zero(4, 4);
  auto const zero = test::spd(Z);
  CHECK(slant::largest_eigenvalue_bound(zero, VectorXd(4)).upper == 0);
  MatrixXd const N = -MatrixXd::Identity(4, 4);
  auto const negative = test::spd(N);
  CHECK_THROWS_AS((void)slant::largest_eigenvalue_bound(negative, VectorXd(4)), slant::bad_input);
  auto const M = test::with_spectrum(test::log_spaced(4, 2));
  auto const A = test::spd(M);
  CHECK_THROWS_WITH_AS((void)slant::largest_eigenvalue_bound(A, VectorXd(4), {.steps = 1}),
                       "steps: got 1, expected at least 2 Lanczos steps", slant::bad_input);
  CHECK_THROWS_AS((void)slant::largest_eigenvalue_bound(A, VectorXd(4), {.failure = 0}),
                  slant::bad_input);
}

}  // namespace spectral_bound_test
