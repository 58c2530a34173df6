// SPDX-License-Identifier: MIT
#include <slant/operators/small_blocks.hpp>

#include <support/testing.hpp>
#include "oracle/hard_points.hpp"
#include "oracle/precise.hpp"

namespace definite_inverse_test {

/// max |A⁻¹ − B| / max |A⁻¹| in units of epsilon, A⁻¹ by fifty digits.
template <class S, int N>
double inverse_error(Eigen::Matrix<S, N, N> const& a) {
  using wide = Eigen::Matrix<oracle::float_50, N, N>;
  wide const exact = wide(a.template cast<oracle::float_50>()).inverse();
  wide const found = slant::detail::definite_inverse(a).template cast<oracle::float_50>();
  return static_cast<double>((exact - found).cwiseAbs().maxCoeff() / exact.cwiseAbs().maxCoeff()) /
         static_cast<double>(std::numeric_limits<S>::epsilon());
}

TEST_CASE_TEMPLATE("definite inverse: G Gᵀ + I of every scale", S, float, double, long double) {
  oracle::number_source<S> source(11);
  S const unit = std::sqrt(std::sqrt(std::numeric_limits<S>::max()));
  double worst = 0;
  for (int i = 0; i < 400; ++i) {
    Eigen::Matrix<S, 3, 3> g;
    for (int j = 0; j < 3; ++j) g.col(j) = source.template direction<3>();
    Eigen::Matrix<S, 3, 3> const a =
        g * g.transpose() + Eigen::Matrix<S, 3, 3>::Identity();  // condition at most 4
    for (S const& scale : {S(1), unit, S(S(1) / unit)}) {
      worst = std::max(worst, inverse_error<S, 3>(Eigen::Matrix<S, 3, 3>(scale * a)));
    }
  }
  CHECK(worst < 16);
}

TEST_CASE("definite inverse: a stiff direction beside soft ones") {
  oracle::number_source<double> source(12);
  double worst = 0;
  for (int i = 0; i < 400; ++i) {
    Vector3d const e = source.direction<3>();
    double const stiffness = std::pow(10.0, i % 9);
    Eigen::Matrix3d const a = Eigen::Matrix3d::Identity() + stiffness * e * e.transpose();
    worst = std::max(worst, inverse_error<double, 3>(a) / stiffness);
  }
  CHECK(worst < 16);  // epsilon times the condition
}

TEST_CASE("definite inverse: known ones; of zero it is zero") {
  CHECK(slant::detail::definite_inverse(Eigen::Matrix<double, 1, 1>(4.0))(0, 0) == 0.25);
  Eigen::Matrix3d const d = Vector3d(2, 0x1p900, 0x1p-900).asDiagonal();
  CHECK(slant::detail::definite_inverse(d) ==
        Eigen::Matrix3d(Vector3d(0.5, 0x1p-900, 0x1p900).asDiagonal()));
  Eigen::Matrix2d a;
  a << 2, 99, 1, 1;  // the upper triangle is not read
  Eigen::Matrix2d expected;
  expected << 1, -1, -1, 2;
  CHECK(slant::detail::definite_inverse(a) == expected);
  CHECK(slant::detail::definite_inverse(Eigen::Matrix2d(Eigen::Matrix2d::Zero())) ==
        Eigen::Matrix2d::Zero());
  Eigen::Matrix2d const singular = Vector2d(4, 0).asDiagonal();
  CHECK(slant::detail::definite_inverse(singular) ==
        Eigen::Matrix2d(Vector2d(0.25, 0).asDiagonal()));
}

}  // namespace definite_inverse_test
