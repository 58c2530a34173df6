// SPDX-License-Identifier: MIT
#include <slant/base/scaling.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/krylov/krylov.hpp>

#include <support/testing.hpp>
#include "krylov/spd_matrices.hpp"
#include "oracle/hard_points.hpp"
#include "oracle/precise.hpp"

namespace scaling_test {

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
  for (int i = 0; i < 50; ++i)
    worst = std::max(worst, norm_error<double, 200>(source.direction<200>()));
  CHECK(worst < 2.0);
}

TEST_CASE("scaled norm: extremes") {
  using vec = Eigen::Vector2d;
  using slant::detail::scaled_norm;
  double const max = std::numeric_limits<double>::max();
  CHECK(scaled_norm<double, 2>(vec(0, 0)).value == 0.0);
  CHECK(scaled_norm<double, 2>(vec(infinity, 1)).value == infinity);
  CHECK(std::isnan(scaled_norm<double, 2>(vec(infinity, quiet_nan)).value));
  CHECK(std::isnan(scaled_norm<double, 2>(vec(0, quiet_nan)).value));
  CHECK(norm_error<double, 2>(vec(max, max)) < 2.0);
  CHECK(norm_error<double, 2>(vec(3 * 5e-324, 4 * 5e-324)) < 2.0);
  CHECK(scaled_norm<double, 2>(vec(3, 4)).exponent == 0);
  CHECK(scaled_norm<double, 2>(vec(3, 4)).value == 5.0);
}

TEST_CASE("the unit is a power of two next to the size, whose reciprocal is finite") {
  CHECK(slant::unit_near(1.0) == 2);
  CHECK(slant::unit_near(0.75) == 1);
  CHECK(slant::unit_near(3e-5f) == 0x1p-15f);
  CHECK(slant::unit_near(0.0) == 1);
  CHECK(slant::unit_near(std::nan("")) == 1);
  CHECK(slant::unit_near(std::numeric_limits<double>::infinity()) == 1);
  for (double extreme :
       {std::numeric_limits<double>::max(), std::numeric_limits<double>::denorm_min()}) {
    CHECK(std::isfinite(1 / slant::unit_near(extreme)));
    CHECK(slant::unit_near(extreme) > 0);
  }
}

TEST_CASE("A and b of size 1e±150: the same bits after the same steps") {
  auto const M = test::with_spectrum(test::log_spaced(40, 100));
  VectorXd const b = test::random_vector(40);
  auto const runs = [&](int stiffness, int load) {
    double const s = std::ldexp(1.0, stiffness), t = std::ldexp(1.0, load);
    auto const A = test::spd(MatrixXd(s * M));
    VectorXd const right = t * b, zero = VectorXd::Zero(40);
    auto const stop = slant::residual_below(1e-12) || slant::at_most(400);
    struct run {
      slant::status status;
      slant::index iterations;
      VectorXd x;
    };
    auto const summary = [&](auto const& r) {
      return run{r.status, r.iterations(), VectorXd(r.x() / t * s)};
    };
    return std::vector{summary(slant::solve(slant::cg{A, right}, zero, stop)),
                       summary(slant::solve(slant::bicgstab{A, right}, zero, stop))};
  };
  auto const plain = runs(0, 0);
  for (auto const& [stiffness, load] :
       {std::pair{498, 0}, {-498, 0}, {0, 498}, {0, -498}, {498, 498}, {-498, -498}}) {
    auto const scaled = runs(stiffness, load);
    for (std::size_t i = 0; i < plain.size(); ++i) {
      CAPTURE(i);
      CAPTURE(stiffness);
      CAPTURE(load);
      CHECK(plain[i].status == slant::status::converged);
      CHECK(scaled[i].status == plain[i].status);
      CHECK(scaled[i].iterations == plain[i].iterations);
      CHECK(scaled[i].x == plain[i].x);
    }
  }
}

}  // namespace scaling_test
