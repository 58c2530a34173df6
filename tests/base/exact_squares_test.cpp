// SPDX-License-Identifier: MIT
#include <slant/base/double_word.hpp>

#include "oracle/hard_points.hpp"
#include "oracle/precise.hpp"

#include <doctest/doctest.h>

#include <limits>

namespace exact_squares_test {

using oracle::float_100;

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

}  // namespace exact_squares_test
