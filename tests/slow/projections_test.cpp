// SPDX-License-Identifier: MIT
//
// Every projection at a million random and adversarial points against a multiprecision oracle.
#include <slant/sets/sets.hpp>

#include <support/testing.hpp>
#include "oracle/projection_errors.hpp"

namespace projections_test {

using oracle::float_50;
constexpr int million = 1000000;

template <class Errors>
void check(Errors const& errors, double bound) {
  CAPTURE(errors.worst.first);
  CAPTURE(errors.worst.second);
  CAPTURE(errors.worst.x);
  CHECK(errors.ulp <= bound);
  CHECK(errors.outside == 0);
}

TEST_CASE("a million points: half line") {
  auto const make = [](double l, double) { return slant::half_line<double>(l); };
  check(oracle::bound_errors(make, false, million, 101), 0);
}

TEST_CASE("a million points: interval") {
  auto const make = [](double l, double u) { return slant::interval<double>(l, u); };
  check(oracle::bound_errors(make, true, million, 102), 0);
}

TEST_CASE("a million points: ball") {
  check(oracle::ball_errors<double, float_50, 2>(million, 103), 4);
  check(oracle::ball_errors<double, float_50, 3>(million, 104), 4);
  check(oracle::ball_errors<float, float_50, 2>(million, 105), 4);
  check(oracle::ball_errors<long double, float_50, 3>(million, 106), 4);
}

TEST_CASE("a million points: ellipse") {
  check(oracle::ellipse_errors<double, float_50, long double>(million, 107), 2);
  check(oracle::ellipse_errors<float, float_50, long double>(million, 108), 2);
  check(oracle::ellipse_errors<long double, oracle::float_100, long double>(million / 4, 109), 2);
}

TEST_CASE("a million points: second-order cone") {
  check(oracle::cone_errors<double, float_50, 2>(million, 110), 2);
  check(oracle::cone_errors<double, float_50, 3>(million, 111), 2);
  check(oracle::cone_errors<float, float_50, 3>(million, 112), 2);
  check(oracle::cone_errors<long double, float_50, 3>(million, 113), 2);
}

TEST_CASE("projections of numbers with 50 digits") {
  check(oracle::ball_errors<float_50, oracle::float_100, 2>(50000, 114), 4);
  check(oracle::ellipse_errors<float_50, oracle::float_100, float_50>(10000, 115), 2);
  check(oracle::cone_errors<float_50, oracle::binary_float<200>, 3>(50000, 116), 2);
}

}  // namespace projections_test
