// SPDX-License-Identifier: MIT
#include <slant/base/double_word.hpp>

#include <support/testing.hpp>
#include "oracle/hard_points.hpp"
#include "oracle/precise.hpp"

namespace double_word_test {

using slant::detail::double_word;
using real = oracle::binary_float<250>;
using oracle::float_100;

// Wide enough for products of double words of long double and of float_50 without rounding.

template <class S>
real exact(double_word<S> const& v) {
  return real(v.hi) + real(v.lo);
}

template <class S>
double_word<S> random_word(oracle::number_source<S>& source) {
  S const high = source.of_size(-3, 3);
  return slant::detail::ordered_sum(
      high, S(source.of_size(-1, 0) * high * std::numeric_limits<S>::epsilon() / S(8)));
}

TEST_CASE_TEMPLATE("double word: sums and products of two numbers lose nothing", S, float, double,
                   long double) {
  oracle::number_source<S> source(1);
  for (int i = 0; i < 500; ++i) {
    S const a = source.of_size(-6, 6), b = i % 3 == 0 ? source.nudged(-a) : source.of_size(-6, 6);
    auto const sum = slant::detail::exact_sum(a, b);
    auto const product = slant::detail::exact_product(a, b);
    CHECK(sum.hi == S(a + b));
    CHECK(exact(sum) == real(a) + real(b));
    CHECK(product.hi == S(a * b));
    CHECK(exact(product) == real(a) * real(b));
  }
}

TEST_CASE("double word: sums of Boost numbers lose nothing, which their own rounding would") {
  using S = oracle::float_50;
  oracle::number_source<S> source(7);
  for (int i = 0; i < 20000; ++i) {
    S const a = source.of_size(-1, 1);
    S const b = i % 3 == 0 ? source.nudged(S(-a)) : source.of_size(-60, 1);
    CHECK(exact(slant::detail::exact_sum(a, b)) == real(a) + real(b));
  }
}

TEST_CASE_TEMPLATE("double word: relative error below 20 u²", S, float, double, long double,
                   oracle::float_50) {
  oracle::number_source<S> source(2);
  real const u = real(std::numeric_limits<S>::epsilon()) / 2;
  real const bound = 20 * u * u;
  for (int i = 0; i < 500; ++i) {
    auto const a = random_word(source);
    auto const b = i % 3 == 0 ? double_word<S>(source.nudged(S(-a.hi))) : random_word(source);
    real const x = exact(a), y = exact(b);
    CHECK(abs(exact(a + b) - (x + y)) <= bound * abs(x + y));
    CHECK(abs(exact(a - b) - (x - y)) <= bound * abs(x - y));
    CHECK(abs(exact(a * b) - x * y) <= bound * abs(x * y));
    CHECK(abs(exact(a / b) - x / y) <= bound * abs(x / y));
    auto const positive = a.hi > S(0) ? a : -a;
    real const root = sqrt(exact(positive));
    CHECK(abs(exact(slant::detail::square_root(positive)) - root) <= bound * root);
  }
  CHECK(slant::detail::square_root(double_word<S>(S(0))).hi == S(0));
}

TEST_CASE_TEMPLATE("double word: an inner product that cancels keeps its digits", S, float, double,
                   long double) {
  using vec = Eigen::Matrix<S, 3, 1>;
  S const ε = std::numeric_limits<S>::epsilon();
  vec const a(S(1) + ε, S(1), S(1)), b(S(1) - ε, S(-1), ε * ε);
  // (1 + ε)(1 − ε) − 1 + ε² = 0, while the rounded products give ε².
  CHECK(slant::detail::precise_dot<S>(a, b).hi == S(0));
  CHECK(slant::detail::precise_dot<S>(a, vec(S(1) - ε, S(-1), S(0))).hi == -ε * ε);
}

TEST_CASE("exact_squares: what cancels to the last digits of the squares is still right") {
  oracle::number_source<double> source(1);
  double worst = 0;
  for (int i = 0; i < 500; ++i) {
    double const m = source.of_size(-2, 2), a = source.of_size(-2, 2), b = source.of_size(-2, 2);
    // c with c² = m²a² + m²b² up to half a unit of its last place, or a few.
    double const c = source.nudged(std::abs(m) * std::hypot(a, b), 2);
    slant::detail::exact_squares<double, 3> squares;
    squares.add(m, a);
    squares.add(m, b);
    squares.subtract(1.0, c);
    auto const sum = squares.sum();
    float_100 const M(m), A(a), B(b), C(c);
    float_100 const exact = M * M * (A * A + B * B) - C * C;
    worst = std::max(worst, oracle::ulp_distance<double>(sum.hi, exact));
  }
  CHECK(worst <= 1);
  slant::detail::exact_squares<double, 2> nothing;
  nothing.add(3.0, 0.1);
  nothing.subtract(0.1, 3.0);
  CHECK(nothing.sum().hi == 0.0);
}

}  // namespace double_word_test
