// SPDX-License-Identifier: MIT
//
// Every projection at a million random and adversarial points against a multiprecision oracle.
#include <slant/sets/half_line.hpp>
#include <slant/sets/interval.hpp>

#include "oracle/projection_errors.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <utility>

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

/// Points of all sizes and within a few ulp of both bounds; l = −∞, u = ∞ and l = u among them.
template <class Make>
void check_bounds(Make const& make, bool two_sided, unsigned seed) {
  double const inf = std::numeric_limits<double>::infinity();
  oracle::number_source<double> source(seed);
  oracle::projection_errors<double, 1> errors;
  for (int i = 0; i < million; ++i) {
    double l = i % 7 == 0 ? 0.0 : i % 11 == 0 ? -inf : source.any_size();
    double u = !two_sided || i % 13 == 0 ? inf
               : i % 5 == 0 && l > -inf  ? source.nudged(l)
                                         : source.any_size();
    if (l > u) std::swap(l, u);
    oracle::hard_point<double, 1> p{l, u, {}};
    p.x(0) = i % 3 == 0 ? source.any_size() : source.nudged(i % 3 == 1 ? l : u);
    if (!p.x.allFinite()) p.x(0) = source.any_size();
    auto const exact =
        naive::project_box<float_50, 1>(oracle::widen<float_50>(p.x), float_50(l), float_50(u));
    errors.record(make(l, u), p, exact, float_50(std::numeric_limits<double>::min()));
  }
  check(errors, 0);
}

TEST_CASE("a million points: half line") {
  check_bounds([](double l, double) { return slant::half_line<double>(l); }, false, 101);
}

TEST_CASE("a million points: interval") {
  check_bounds([](double l, double u) { return slant::interval<double>(l, u); }, true, 102);
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
