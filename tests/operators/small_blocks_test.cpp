// SPDX-License-Identifier: MIT
#include <slant/operators/small_blocks.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>
#include "oracle/hard_points.hpp"
#include "oracle/precise.hpp"

namespace small_blocks_test {

TEST_CASE("blocks of one, two and three components among others: the matrix it stands for") {
  // 0 1 2 3 4 5 6 7: a block (1), a block (0, 4), a block (2, 5, 7 − …) with stride 2: (3, 5, 7).
  slant::small_blocks<double, slant::laws<slant::positive_definite>> B(8);
  B.append(1, 1, 1);
  B.append(2, 0, 4);
  B.append(3, 3, 2);
  B.block(0)(0, 0) = 5;
  B.block(1) = MatrixXd{{2.0, 0.5}, {0.5, 3.0}};
  B.block(2) = MatrixXd{{4.0, 1.0, 0.0}, {1.0, 4.0, -1.0}, {0.0, -1.0, 4.0}};
  B.assign_outside(VectorXd(VectorXd::LinSpaced(8, 10, 17)));
  CHECK(B.block_count() == 3);
  MatrixXd M = MatrixXd::Zero(8, 8);
  M(1, 1) = 5;
  M(0, 0) = 2;
  M(4, 4) = 3;
  M(0, 4) = M(4, 0) = 0.5;
  for (int i : {3, 5, 7}) M(i, i) = 4;
  M(3, 5) = M(5, 3) = 1;
  M(5, 7) = M(7, 5) = -1;
  M(2, 2) = 12;
  M(6, 6) = 16;
  VectorXd const x = VectorXd::LinSpaced(8, -1, 2.5);
  VectorXd y = VectorXd::Constant(8, 1e300), d(8);
  B.apply(x, y);
  CHECK((y - M * x).norm() <= 1e-15 * M.norm());
  B.apply_add(2.0, x, y);
  CHECK((y - 3 * M * x).norm() <= 1e-14 * M.norm());
  B.diagonal(d);
  CHECK(d == M.diagonal());
  slant::testing::check_operator_laws(B);
}

/// max |A⁻¹ − B| / max |A⁻¹| in units of epsilon, A⁻¹ by fifty digits.
template <class S, int N>
double inverse_error(Eigen::Matrix<S, N, N> const& a) {
  using wide = Eigen::Matrix<oracle::float_50, N, N>;
  wide const exact = wide(a.template cast<oracle::float_50>()).inverse();
  wide const found = slant::detail::definite_inverse(a).template cast<oracle::float_50>();
  return static_cast<double>((exact - found).cwiseAbs().maxCoeff() / exact.cwiseAbs().maxCoeff()) /
         static_cast<double>(std::numeric_limits<S>::epsilon());
}

TEST_CASE_TEMPLATE("definite inverse: G Gᵀ + I of every scale", S, float, long double) {
  oracle::number_source<S> source(11);
  S const unit = std::sqrt(std::sqrt(std::numeric_limits<S>::max()));
  double worst = 0;
  for (int i = 0; i < 400; ++i) {
    Eigen::Matrix<S, 3, 3> g;
    for (int j = 0; j < 3; ++j) g.col(j) = source.template direction<3>();
    Eigen::Matrix<S, 3, 3> const a =
        g * g.transpose() + Eigen::Matrix<S, 3, 3>::Identity();  // condition at most 4
    for (S const& scale : {S(1), unit, S(S(1) / unit)})
      worst = std::max(worst, inverse_error<S, 3>(Eigen::Matrix<S, 3, 3>(scale * a)));
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

}  // namespace small_blocks_test
