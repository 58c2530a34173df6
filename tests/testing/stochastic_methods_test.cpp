// SPDX-License-Identifier: MIT
//
// Every method takes the stochastic scalar unchanged, and what it says of the digits is true where
// the truth is known.
#include <slanting/slanting_support.hpp>
#include <support/testing.hpp>
#include "stochastic_scene.hpp"

namespace stochastic_methods_test {

using S = slant::testing::stochastic<double>;
using wide = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

/// The solution of A x = b without constraints, by elimination in long double.
wide solved(stochastic_scene::scene<S> const& p) {
  int const n = int(p.size);
  Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic> A(n, n);
  wide b(n);
  for (int i = 0; i < n; ++i) {
    b[i] = p.b[i].mean();
    for (int j = 0; j < n; ++j) A(i, j) = p.A(i, j).mean();
  }
  return slanting_support::solve(A, b);
}

/// Digits that the worst sample shares with the solution, beside its largest entry.
double true_digits(stochastic_scene::scene<S>::vector const& x, wide const& exact) {
  long double error = 0, largest = 0;
  for (int i = 0; i < int(x.size()); ++i) {
    largest = std::max(largest, std::fabs(exact[i]));
    for (int k = 0; k < 3; ++k)
      error = std::max(error, std::fabs(static_cast<long double>(x[i].sample(k)) - exact[i]));
  }
  return static_cast<double>(-std::log10(error / largest));
}

TEST_CASE("all methods converge, and lose no more digits than the condition takes") {
  for (double const κ : {10.0, 1e4}) {
    CAPTURE(κ);
    slant::testing::seed_rounding(1);
    stochastic_scene::run_all(stochastic_scene::scene<S>(κ), 1e-10, [&](auto const& o) {
      CAPTURE(o.method);
      CHECK(o.status == slant::status::converged);
      CHECK(slant::testing::digits(o.x) > 13.5 - std::log10(κ));
      CHECK(slant::testing::digits(o.x) < 15.96);
    });
  }
}

TEST_CASE("a factorisation: the true digits, within one") {
  for (double const κ : {1e3, 1e6, 1e9}) {
    CAPTURE(κ);
    stochastic_scene::scene<S> const p(κ);
    auto const exact = solved(p);
    for (std::uint64_t const seed : {1U, 2U, 3U}) {
      slant::testing::seed_rounding(seed);
      stochastic_scene::scene<S>::vector x(p.size);
      Eigen::SparseMatrix<S> const K = p.A.sparseView();
      slant::ldlt<S> const factor(K);
      auto w = factor.workspace(x);
      factor.solve(p.b, x, w);
      double const said = slant::testing::digits(x), is = true_digits(x, exact);
      CAPTURE(seed);
      CHECK(said <= is + 1);
      CHECK(said >= is - 1);
    }
  }
}

}  // namespace stochastic_methods_test
