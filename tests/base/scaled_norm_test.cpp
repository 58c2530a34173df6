// SPDX-License-Identifier: MIT
#include <slant/base/scaling.hpp>

#include <support/testing.hpp>
#include "oracle/hard_points.hpp"
#include "oracle/precise.hpp"

namespace scaled_norm_test {

template <class S, int N>
double norm_error(Eigen::Matrix<S, N, 1> const& v) {
  auto const norm = slant::detail::scaled_norm<S, N>(v);
  oracle::float_50 const exact = oracle::widen<oracle::float_50>(v).norm();
  oracle::float_50 const computed = ldexp(oracle::float_50(norm.value), norm.exponent);
  return static_cast<double>(abs(computed - exact) / exact) /
         static_cast<double>(std::numeric_limits<S>::epsilon());
}

TEST_CASE_TEMPLATE("scaled norm: relative error below 2 epsilon over the whole range", S, float,
                   double, long double) {
  oracle::number_source<S> source(3);
  double const top = std::numeric_limits<S>::max_exponent10 - 1;
  double const bottom = std::numeric_limits<S>::min_exponent10 + 1;
  double worst = 0;
  for (int i = 0; i < 5000; ++i) {
    Eigen::Matrix<S, 3, 1> const v =
        source.of_size(i % 2 == 0 ? bottom : -3, i % 2 == 0 ? top : 3) *
        source.template direction<3>();
    worst = std::max(worst, norm_error<S, 3>(v));
  }
  CHECK(worst < 2.0);
}

TEST_CASE("scaled norm: the error does not grow with the dimension") {
  oracle::number_source<double> source(4);
  double worst = 0;
  for (int i = 0; i < 50; ++i) {
    worst = std::max(worst, norm_error<double, 200>(source.direction<200>()));
  }
  CHECK(worst < 2.0);
}

TEST_CASE("scaled norm: extremes") {
  using vec = Eigen::Vector2d;
  using slant::detail::scaled_norm;
  double const inf = std::numeric_limits<double>::infinity();
  double const quiet_nan = std::numeric_limits<double>::quiet_NaN();
  double const max = std::numeric_limits<double>::max();
  CHECK(scaled_norm<double, 2>(vec(0, 0)).value == 0.0);
  CHECK(scaled_norm<double, 2>(vec(inf, 1)).value == inf);
  CHECK(std::isnan(scaled_norm<double, 2>(vec(inf, quiet_nan)).value));
  CHECK(std::isnan(scaled_norm<double, 2>(vec(0, quiet_nan)).value));
  CHECK(norm_error<double, 2>(vec(max, max)) < 2.0);
  CHECK(norm_error<double, 2>(vec(3 * 5e-324, 4 * 5e-324)) < 2.0);
  CHECK(scaled_norm<double, 2>(vec(3, 4)).exponent == 0);
  CHECK(scaled_norm<double, 2>(vec(3, 4)).value == 5.0);
}

}  // namespace scaled_norm_test
