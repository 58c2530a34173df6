// SPDX-License-Identifier: MIT
#include <slant/krylov/spectral_bound.hpp>

#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>

#include <cmath>
#include <random>
#include <vector>

namespace tridiagonal_eigenvalue_test {

using slant::detail::largest_tridiagonal_eigenvalue;
using slant::detail::smallest_tridiagonal_eigenvalue;

/// All eigenvalues, ascending.
Eigen::VectorXd by_eigen(std::vector<double> const& a, std::vector<double> const& b) {
  auto const n = Eigen::Index(a.size());
  Eigen::MatrixXd T = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    T(i, i) = a[std::size_t(i)];
    if (i + 1 < n) T(i, i + 1) = T(i + 1, i) = b[std::size_t(i)];
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(T).eigenvalues();
}

TEST_CASE("random matrices of all sizes, as by a dense eigenvalue solver") {
  std::mt19937 generator(7);
  std::normal_distribution<double> gaussian;
  for (std::size_t n = 1; n <= 30; ++n) {
    std::vector<double> a(n), b(n - 1);
    for (auto& e : a) e = gaussian(generator);
    for (auto& e : b) e = std::exp(3 * gaussian(generator));
    Eigen::VectorXd const expected = by_eigen(a, b);
    double const tolerance = 1e-14 * double(n) * (expected.cwiseAbs().maxCoeff() + 1);
    CHECK(std::abs(largest_tridiagonal_eigenvalue(a, b) - expected(expected.size() - 1)) <=
          tolerance);
    CHECK(std::abs(smallest_tridiagonal_eigenvalue(a, b) - expected(0)) <= tolerance);
  }
}

TEST_CASE("closed form: tridiag(-1, 2, -1)") {
  for (std::size_t const n : {1U, 2U, 5U, 100U}) {
    std::vector<double> const a(n, 2.0), b(n - 1, -1.0);
    double const π = std::acos(-1.0), λ = 2 - 2 * std::cos(double(n) * π / double(n + 1));
    CHECK(largest_tridiagonal_eigenvalue(a, b) == doctest::Approx(λ).epsilon(1e-15));
    CHECK(smallest_tridiagonal_eigenvalue(a, b) == doctest::Approx(4 - λ).epsilon(1e-12));
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

}  // namespace tridiagonal_eigenvalue_test
