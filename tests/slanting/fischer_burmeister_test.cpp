// SPDX-License-Identifier: MIT
#include <slant/slanting/slanting.hpp>
#include <slant/testing/laws.hpp>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <support/testing.hpp>
#include "slanting_support.hpp"

namespace fischer_burmeister_test {

using kernel = slant::detail::fischer_burmeister_kernel;
using oracle = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<100>,
                                             boost::multiprecision::et_off>;

/// Distance in units of the last place of the exact result.
double ulps(double computed, oracle const& exact) {
  if (exact == 0) return computed == 0 ? 0 : std::numeric_limits<double>::infinity();
  oracle const error = abs(oracle(computed) - exact) / abs(exact);
  return static_cast<double>(error) / std::numeric_limits<double>::epsilon();
}

struct worst_case {
  double error = 0;
  std::string place;
  void operator()(double e, double a, double b) {
    if (e <= error) return;
    error = e;
    place = std::to_string(a) + ", " + std::to_string(b);
  }
};

TEST_CASE("known values") {
  CHECK(kernel::value(3.0, 4.0) == doctest::Approx(-2.0).epsilon(1e-15));
  CHECK(kernel::value(-3.0, -4.0) == doctest::Approx(12.0).epsilon(1e-15));
  CHECK(kernel::value(0.0, 0.0) == 0.0);
  CHECK(kernel::value(5.0, 0.0) == 0.0);  // exactly: complementary pairs are zeros
  CHECK(kernel::value(0.0, 1e-300) == 0.0);
  CHECK(kernel::value(-2.0, 0.0) == 4.0);
  CHECK(kernel::value(1.0, 1e-40) == -1e-40);
  CHECK(std::isnan(kernel::value(std::nan(""), 1.0)));
  CHECK(std::isnan(kernel::value(0.0, std::nan(""))));
  CHECK(kernel::value(std::numeric_limits<double>::infinity(), 2.0) == -2.0);
}

TEST_CASE("value and slopes against 100 digits, at all scales") {
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> mantissa(-1, 1);
  std::uniform_int_distribution<int> exponent(-440, 440);
  std::uniform_int_distribution<int> gap(-60, 60);
  worst_case value;
  worst_case at_a;
  worst_case at_b;
  auto const compare = [&](double a, double b) {
    oracle const p(a);
    oracle const q(b);
    oracle const h = sqrt(oracle(p * p + q * q));
    value(ulps(kernel::value(a, b), oracle(h - p - q)), a, b);
    if (h == 0) return;
    auto const [slope_a, slope_b] = kernel::slopes(a, b);
    at_a(ulps(slope_a, oracle(p / h - 1)), a, b);
    at_b(ulps(slope_b, oracle(q / h - 1)), a, b);
  };
  for (int i = 0; i < 1000; ++i) {
    int const e = exponent(engine);
    compare(std::ldexp(mantissa(engine), e), std::ldexp(mantissa(engine), e + gap(engine)));
    double const a = std::ldexp(mantissa(engine), e);
    compare(a, -a);
    compare(a, -std::nextafter(a, 0));
    compare(a, std::nextafter(a, 0));
    compare(a, 0);
    compare(0, a);
  }
  CAPTURE(value.place);
  CHECK(value.error <= 4);
  CAPTURE(at_a.place);
  CHECK(at_a.error <= 4);
  CAPTURE(at_b.place);
  CHECK(at_b.error <= 4);
}

TEST_CASE("nothing overflows that the result does not") {
  double const huge = std::numeric_limits<double>::max();
  CHECK(kernel::value(huge, huge) == doctest::Approx(huge * (std::sqrt(2.0) - 2)));
  CHECK(kernel::value(huge, 1e-20) == -1e-20);
  CHECK(kernel::value(-huge / 4, huge / 4) == doctest::Approx(huge / 4 * std::sqrt(2.0)));
  CHECK(kernel::value(-huge, -huge) == std::numeric_limits<double>::infinity());
  double const tiny = std::numeric_limits<double>::min();
  CHECK(kernel::value(tiny, tiny) == doctest::Approx(tiny * (std::sqrt(2.0) - 2)));
}

TEST_CASE("the slope at (0, 0) is the limit along a = b > 0") {
  double const slope = std::sqrt(0.5) - 1;
  CHECK(kernel::slopes(0.0, 0.0) == std::pair(slope, slope));
  CHECK(kernel::slopes(-0.0, 0.0) == std::pair(slope, slope));
  auto const [a, b] = kernel::slopes(1e-200, 1e-200);
  CHECK(a == doctest::Approx(slope));
  CHECK(b == doctest::Approx(slope));
}

TEST_CASE("of two functions: values, chain rule, laws") {
  MatrixXd const m = slanting_support::random_spd(4, 3);
  VectorXd const b = slanting_support::random_vector(4, 5);
  auto const f = slant::fischer_burmeister(slant::identity_map(4), slant::affine(m, -b));
  VectorXd const y{{1.0, 0.0, -2.0, 0.3}};
  VectorXd const r = m * y - b;
  VectorXd const value = slant::evaluate(f, y);
  MatrixXd expected = m;
  for (int i = 0; i < 4; ++i) {
    double const h = std::hypot(y[i], r[i]);
    CHECK(value[i] == doctest::Approx(h - y[i] - r[i]));
    expected.row(i) *= r[i] / h - 1;
    expected(i, i) += y[i] / h - 1;
  }
  CHECK((slanting_support::dense_slant(f, y) - expected).norm() <= 1e-14 * expected.norm());
  // Both arguments are 0 at the second point: the kink in every component.
  slant::testing::check_slanting_laws(f, y, slanting_support::solve(m, b));
  auto const both = slant::fischer_burmeister(slant::identity_map(3), slant::identity_map(3));
  slant::testing::check_slanting_laws(both, test::zeros(3), VectorXd{{1.0, 0.0, -1.0}});
}

TEST_CASE("float, long double and multiprecision") {
  CHECK(kernel::value(3.0F, 4.0F) == doctest::Approx(-2.0F));
  CHECK(std::abs(kernel::value(3.0L, 4.0L) + 2.0L) <=
        4 * std::numeric_limits<long double>::epsilon());
  using wide = boost::multiprecision::cpp_bin_float_50;
  CHECK(abs(kernel::value(wide(3), wide(4)) + 2) <= 4 * std::numeric_limits<wide>::epsilon());
  auto const [a, b] = kernel::slopes(wide(3), wide(4));
  CHECK(abs(a + wide(2) / 5) <= 4 * std::numeric_limits<wide>::epsilon());
  CHECK(abs(b + wide(1) / 5) <= 4 * std::numeric_limits<wide>::epsilon());
}

}  // namespace fischer_burmeister_test
