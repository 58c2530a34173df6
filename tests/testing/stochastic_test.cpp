// SPDX-License-Identifier: MIT
//
// The stochastic scalar knows what rounding has left of computations whose errors are known, and
// every method takes it unchanged.
#include <slant/testing/stochastic.hpp>

#include <slanting/slanting_support.hpp>
#include <support/testing.hpp>
#include "stochastic_scene.hpp"

namespace stochastic_test {

using slant::testing::digits;
using slant::testing::stochastic;
using S = stochastic<double>;

S of(double x) {
  return S(x);
}

/// Polynomial of Rump (1988): its terms are 1e37 large, its value −54767/66192 = −0.827….
S rump() {
  S const a = of(77617), b = of(33096), b2 = b * b, b4 = b2 * b2, b6 = b4 * b2;
  return of(333.75) * b6 + a * a * (of(11) * a * a * b2 - b6 - of(121) * b4 - of(2)) +
         of(5.5) * b4 * b4 + a / (of(2) * b);
}

/// The smaller zero of x² − p x + 1, by the formula that cancels.
S small_zero(double p) {
  return (of(p) - sqrt(of(p) * of(p) - of(4))) / of(2);
}

/// exp(x) by its power series, without help for x < 0.
S power_series(double x) {
  S sum = of(1), term = of(1);
  for (int k = 1; k < 200; ++k) {
    term *= of(x) / S(k);
    sum += term;
  }
  return sum;
}

/// x₀ = 11/2, x₁ = 61/11, x⁺ = 111 − (1130 − 3000 / x⁻) / x: of Muller; tends to 6, computed to
/// 100.
S muller(int steps) {
  S before = of(5.5), x = of(61) / of(11);
  for (int k = 0; k < steps; ++k) {
    S const next = of(111) - (of(1130) - of(3000) / before) / x;
    before = x;
    x = next;
  }
  return x;
}

struct measured {
  double said = 0, known = 0;  ///< digits: the median of those reported; those of the samples
};

/// Runs a computation with many seeds.
template <class Computation>
measured measure(Computation computation, long double exact) {
  std::vector<double> said;
  long double squares = 0;
  int const runs = 101;
  for (int seed = 1; seed <= runs; ++seed) {
    slant::testing::seed_rounding(static_cast<std::uint64_t>(seed));
    S const x = computation();
    said.push_back(digits(x));
    for (int i = 0; i < 3; ++i) {
      long double const error = (x.sample(i) - exact) / exact;
      squares += error * error / (3 * runs);
    }
  }
  std::nth_element(said.begin(), said.begin() + runs / 2, said.end());
  return {said[runs / 2], static_cast<double>(-std::log10(std::sqrt(squares)))};
}

TEST_CASE("digits of known cancellations, within one") {
  auto const check = [](measured const& m) {
    CHECK(m.said >= m.known - 1);
    CHECK(m.said <= m.known + 1);
  };
  for (double p : {1e2, 1e4, 1e6}) {
    CAPTURE(p);
    long double const q = p, zero = 2 / (q + std::sqrt(q * q - 4));
    check(measure([=] { return small_zero(p); }, zero));
  }
  for (double x : {1.0, -5.0, -10.0, -15.0}) {
    CAPTURE(x);
    check(measure([=] { return power_series(x); }, std::exp(static_cast<long double>(x))));
  }
  // (6^(k+1) + 5^(k+1)) / (6^k + 5^k)
  long double const up = std::pow(1.2L, 9);
  check(measure([] { return muller(8); }, (6 * up + 5) / (up + 1)));
}

TEST_CASE("nothing is left of Rump's polynomial") {
  slant::testing::seed_rounding(1);
  S const x = rump();
  CHECK(digits(x) < 1);
  CHECK(to_string(x) == "@.0");
}

TEST_CASE("exact operations stay exact") {
  S const a = of(3), b = of(-0.375);
  for (int k = 0; k < 20; ++k) {
    CHECK((a + b).is_exact());
    CHECK((a * b).is_exact());
    CHECK((b / of(0.25)).is_exact());
    CHECK(sqrt(of(2.25)).is_exact());
    CHECK(sqrt(of(2.25)) == of(1.5));
  }
  CHECK(digits(a) > 15.9);
  CHECK(to_string(of(0)) == "0.00000000000000e+00");
}

TEST_CASE(
    "an inexact result is one of its two neighbours, both equally often, and never looks exact") {
  auto const check = [](auto operation, double below, double above) {
    int high = 0;
    for (int k = 0; k < 1000; ++k) {
      S const x = operation();
      CHECK(!x.is_exact());
      for (int i = 0; i < 3; ++i) {
        CHECK((x.sample(i) == below || x.sample(i) == above));
        high += x.sample(i) == above ? 1 : 0;
      }
    }
    CHECK(high > 1350);
    CHECK(high < 1650);
  };
  slant::testing::seed_rounding(5);
  double const third = 1.0 / 3, root = std::sqrt(2.0), tiny = 1e-30, tenth = 0.1;
  check([] { return of(1) / of(3); }, third, std::nextafter(third, 1.0));     // 1/3 is rounded down
  check([] { return of(1) / of(-3); }, -std::nextafter(third, 1.0), -third);  // hence −1/3 up
  check([] { return sqrt(of(2)); }, std::nextafter(root, 0.0), root);         // √2 up
  check([=] { return of(1) + of(tiny); }, 1.0, std::nextafter(1.0, 2.0));
  check([=] { return of(1) - of(tiny); }, std::nextafter(1.0, 0.0), 1.0);
  check([=] { return of(tenth) * of(tenth); }, std::nextafter(tenth * tenth, 0.0), tenth * tenth);
}

TEST_CASE("a seed gives the same samples again") {
  slant::testing::seed_rounding(9);
  S const x = power_series(-3.5);
  slant::testing::seed_rounding(9);
  S const y = power_series(-3.5);
  for (int i = 0; i < 3; ++i) CHECK(x.sample(i) == y.sample(i));
}

TEST_CASE("text, branches and the ends of the range") {
  CHECK(to_string(S(1.0, 1.001, 0.999)) == "1.0e+00");
  CHECK(to_string(S(1.0, -1.001, 0.1)) == "@.0");
  CHECK(digits(of(std::nan(""))) == 0);
  CHECK(S(1.0, 2.0, 3.0) == of(2));
  CHECK(S(1.0, 2.0, 3.0) < of(2.5));
  CHECK(abs(S(-3.0, -4.0, 1.0)) == of(2));
  CHECK(sqrt(S(-1e-20, 1e-20, 2e-20)) > of(0));
  CHECK(isnan(sqrt(of(-1))));
  S const huge = of(std::numeric_limits<double>::max());
  CHECK(huge.mean() == std::numeric_limits<double>::max());
  CHECK((huge + huge).mean() == infinity);
  CHECK((huge * of(-2)).mean() == -infinity);
  CHECK(digits(of(1e-300) / of(3)) > 15);
  int e = 0;
  S const f = frexp(S(12.0, 12.5, 11.5), &e);
  CHECK(e == 4);
  CHECK(f.mean() == 0.75);
  CHECK(frexp(of(5e-324), &e).mean() == 0.5);
  CHECK(e == -1073);
}

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

}  // namespace stochastic_test
