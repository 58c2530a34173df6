// SPDX-License-Identifier: MIT
#include <slant/krylov/spectrum.hpp>
#include <slant/operators/operators.hpp>
#include <slant/testing/archetypes.hpp>

#include <support/testing.hpp>
#include "spd_matrices.hpp"

namespace spectrum_test {

using slant::detail::largest_tridiagonal_eigenvalue;
using slant::detail::smallest_tridiagonal_eigenvalue;

TEST_CASE("the bound is never below the largest eigenvalue, and not far above it") {
  int tested = 0;
  for (Eigen::Index n : {1, 2, 5, 40, test::effort(200, 60)}) {
    for (double κ : {1.0, 10.0, 1e4, 1e12}) {
      for (unsigned seed = 1; seed <= 3; ++seed) {
        auto const M = test::with_spectrum(test::log_spaced(n, κ), seed);
        VectorXd const spectrum = test::eigenvalues_of(M);
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
  Eigen::VectorXf many = Eigen::VectorXf::Ones(100'000);
  many(7) = 3;
  auto const D = slant::diagonal<slant::positive_semidefinite>(many);
  CHECK(slant::largest_eigenvalue_bound(D, many).upper >= 3);
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

/// All eigenvalues, ascending.
VectorXd by_eigen(std::vector<double> const& a, std::vector<double> const& b) {
  auto const n = Eigen::Index(a.size());
  MatrixXd T = MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    T(i, i) = a[std::size_t(i)];
    if (i + 1 < n) T(i, i + 1) = T(i + 1, i) = b[std::size_t(i)];
  }
  return test::eigenvalues_of(T);
}

TEST_CASE("random matrices of all sizes, as by a dense eigenvalue solver") {
  std::mt19937 generator(7);
  std::normal_distribution<double> gaussian;
  for (std::size_t n = 1; n <= 30; ++n) {
    std::vector<double> a(n), b(n - 1);
    for (auto& e : a) e = gaussian(generator);
    for (auto& e : b) e = std::exp(3 * gaussian(generator));
    VectorXd const expected = by_eigen(a, b);
    double const tolerance = 1e-14 * double(n) * (expected.cwiseAbs().maxCoeff() + 1);
    CHECK(std::abs(largest_tridiagonal_eigenvalue(a, b) - expected(expected.size() - 1)) <=
          tolerance);
    CHECK(std::abs(smallest_tridiagonal_eigenvalue(a, b) - expected(0)) <= tolerance);
  }
}

TEST_CASE("decoupled, zero and negative matrices; powers of two change nothing") {
  CHECK(largest_tridiagonal_eigenvalue<double>({3, 7, -1}, {0, 0}) == 7);
  CHECK(smallest_tridiagonal_eigenvalue<double>({3, 7, -1}, {0, 0}) == -1);
  CHECK(largest_tridiagonal_eigenvalue<double>({0, 0}, {0}) == 0);
  CHECK(largest_tridiagonal_eigenvalue<double>({-4, -2}, {0}) == -2);
  std::vector<double> const a{1, 2, 3}, b{0.5, 0.25};
  double const λ = largest_tridiagonal_eigenvalue(a, b);
  for (int e : {-900, 900}) {
    auto const in = [e](std::vector<double> v) {
      for (auto& x : v) x = std::ldexp(x, e);
      return v;
    };
    CHECK(largest_tridiagonal_eigenvalue(in(a), in(b)) == std::ldexp(λ, e));
  }
}

TEST_CASE(
    "the length is best for small condition numbers, near 2/σ_max for large ones, always safe") {
  for (double κ : {1.0, 1.5, 3.0, 10.0, 1e6}) {
    for (Eigen::Index n : {5, 40, test::effort(200, 60)}) {
      auto const M = test::with_spectrum(test::log_spaced(n, κ));
      double const σ = M.operatorNorm();
      auto const step = slant::safe_gradient_step(test::spd(M), VectorXd(n), 1.9);
      CHECK(step.length * σ < 2);
      CHECK(step.length * σ <= 1.9 + 1e-12);
      CHECK(step.length * σ > 0.6 * std::min(1.9, 2 / (1 + 1 / κ)));
      CHECK(step.σ == doctest::Approx(σ).epsilon(0.02));
      CHECK(step.applications <= n);
    }
  }
}

TEST_CASE("zero operator, operators out of range") {
  auto const nothing = slant::declare<slant::self_adjoint, slant::positive_semidefinite>(
      slant::diagonal(test::zeros(3)));
  CHECK(slant::safe_gradient_step(nothing, VectorXd(3), 1.9).length == 1);
  auto const tiny =
      slant::diagonal<slant::positive_definite>(VectorXd(VectorXd::Constant(3, 1e-310)));
  CHECK_THROWS_AS(static_cast<void>(slant::safe_gradient_step(tiny, VectorXd(3), 1.9)),
                  slant::bad_input);
}

TEST_CASE("exact, without a product, where the operator gives its diagonal") {
  MatrixXd const M = test::with_spectrum(test::log_spaced(12, 1e3), 3);
  auto const A = slant::counted(test::spd(M));
  auto const mean = slant::mean_diagonal(A, test::zeros(12));
  CHECK(mean.value == doctest::Approx(M.trace() / 12));
  CHECK(mean.applications == 0);
  CHECK(A.applications() == 0);
}

TEST_CASE("estimated by random signs otherwise, within the variance that is stated") {
  namespace archetype = slant::testing::archetype;
  MatrixXd const M = test::with_spectrum(test::log_spaced(60, 1e2), 8);
  archetype::psd_operator const A(M);
  archetype::vector const like(VectorXd::Zero(60));
  double const off = M.squaredNorm() - M.diagonal().squaredNorm();
  double sum_of_squares = 0;
  for (unsigned seed = 1; seed <= 50; ++seed) {
    auto const mean = slant::mean_diagonal(A, like, {.samples = 4, .seed = seed});
    CHECK(mean.applications == 4);
    sum_of_squares += std::pow(mean.value - M.trace() / 60, 2);
  }
  double const variance = 2 * off / (4 * 60.0 * 60.0);
  CHECK(sum_of_squares / 50 <= 2 * variance);
  CHECK(sum_of_squares / 50 >= variance / 2);
  // A diagonal matrix has no variance.
  archetype::psd_operator const D(MatrixXd(VectorXd::LinSpaced(60, 1, 60).asDiagonal()));
  CHECK(slant::mean_diagonal(D, like, {.samples = 1}).value == doctest::Approx(30.5));
}

TEST_CASE("a step length of its size, or a word about why there is none") {
  namespace archetype = slant::testing::archetype;
  archetype::vector const like(VectorXd::Zero(2));
  auto const step = [&](double size) {
    return slant::mean_step(archetype::psd_operator(size * MatrixXd::Identity(2, 2)), like, 0.5);
  };
  CHECK(step(4.0).length == 0.125);
  CHECK(step(0.0).length == 1.0);  // any: A = 0
  for (double size : {-1.0, 1e-310, std::numeric_limits<double>::quiet_NaN()}) {
    CAPTURE(size);
    CHECK_THROWS_AS(static_cast<void>(step(size)), slant::bad_input);
  }
  archetype::psd_operator const I(MatrixXd::Identity(2, 2));
  CHECK_THROWS_WITH(static_cast<void>(slant::mean_diagonal(I, like, {.samples = 0})),
                    "samples: got 0, expected a number >= 1");
}

}  // namespace spectrum_test
