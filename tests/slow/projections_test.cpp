// SPDX-License-Identifier: MIT
//
// Every projection at a million random and adversarial points against a multiprecision oracle; and the
// laws of sets under many seeds: no honest set may be accused, in single precision neither.
#include <slant/sets/sets.hpp>
#include <slant/testing/set_breaches.hpp>

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

TEST_CASE("a million points: half line, interval") {
  auto const half_line = [](double l, double) { return slant::half_line<double>(l); };
  check(oracle::bound_errors(half_line, false, million, 101), 0);
  auto const interval = [](double l, double u) { return slant::interval<double>(l, u); };
  check(oracle::bound_errors(interval, true, million, 102), 0);
}

TEST_CASE("a million points: ball, ellipse, second-order cone, also of numbers with 50 digits") {
  check(oracle::ball_errors<double, float_50, 2>(million, 103), 4);
  check(oracle::ball_errors<double, float_50, 3>(million, 104), 4);
  check(oracle::ball_errors<float, float_50, 2>(million, 105), 4);
  check(oracle::ball_errors<long double, float_50, 3>(million, 106), 4);
  check(oracle::ellipse_errors<double, float_50, long double>(million, 107), 2);
  check(oracle::ellipse_errors<float, float_50, long double>(million, 108), 2);
  check(oracle::ellipse_errors<long double, oracle::float_100, long double>(million / 4, 109), 2);
  check(oracle::cone_errors<double, float_50, 2>(million, 110), 2);
  check(oracle::cone_errors<double, float_50, 3>(million, 111), 2);
  check(oracle::cone_errors<float, float_50, 3>(million, 112), 2);
  check(oracle::cone_errors<long double, float_50, 3>(million, 113), 2);
  check(oracle::ball_errors<float_50, oracle::float_100, 2>(50000, 114), 4);
  check(oracle::ellipse_errors<float_50, oracle::float_100, float_50>(10000, 115), 2);
  check(oracle::cone_errors<float_50, oracle::binary_float<200>, 3>(50000, 116), 2);
}

/// The first breach under any of the seeds.
template <class C>
std::string accusation(C const& set, double size = 1) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    for (auto const& breach : slant::testing::set_breaches(
             set, slant::testing::set_options{.seed = seed, .size = size})) {
      return "seed " + std::to_string(seed) + ": " + breach.law + ", " + breach.evidence;
    }
  }
  return "";
}

TEST_CASE_TEMPLATE("set laws: no honest set is accused", S, float, double) {
  using vector = Eigen::Matrix<S, 2, 1>;
  Eigen::Matrix<S, 2, 2> q;
  q << S(3) / S(5), S(-4) / S(5), S(4) / S(5), S(3) / S(5);
  CHECK(accusation(slant::half_line<S>{S(-1.5)}) == "");
  CHECK(accusation(slant::interval<S>{S(0.5), S(2)}) == "");
  CHECK(accusation(slant::ball<2, S>{}) == "");
  CHECK(accusation(slant::ball<2, S>{S(1e-7)}, 1e-7) == "");
  CHECK(accusation(slant::ball<3, S>{S(2)}) == "");
  CHECK(accusation(slant::ellipse<S>{S(2), S(1)}) == "");
  CHECK(accusation(slant::ellipse<S>{S(2), S(0.1)}) == "");
  CHECK(accusation(slant::second_order_cone<2, S>{S(2)}) == "");
  CHECK(accusation(slant::second_order_cone<3, S>{S(0.3)}) == "");
  CHECK(accusation(slant::second_order_cone<3, S>{S(0)}) == "");
  CHECK(accusation(slant::second_order_cone<4, S>{S(1)}) == "");
  CHECK(accusation(slant::shifted(slant::ball<2, S>{}, vector(S(3), S(-4)))) == "");
  CHECK(accusation(slant::shifted(slant::second_order_cone<2, S>{S(0.5)}, vector(S(-1), S(2)))) ==
        "");
  CHECK(accusation(slant::scaled(S(2.5), slant::ellipse<S>{S(1), S(0.2)})) == "");
  CHECK(accusation(slant::rotated(slant::ellipse<S>{S(1), S(0.2)}, q)) == "");
  CHECK(accusation(slant::rotated(slant::second_order_cone<2, S>{S(0.5)}, q)) == "");
  std::vector<S> const g{S(1), S(0.3), S(0)};
  CHECK(accusation(slant::cartesian(slant::half_lines<S>(2), slant::discs<slant::planar>(g),
                                    slant::free_components<S>(1))) == "");
}

}  // namespace projections_test
