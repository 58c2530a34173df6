// SPDX-License-Identifier: MIT
#include <slant/contact/rigid_body_modes.hpp>
#include <support/testing.hpp>

namespace rigid_body_modes_test {

using namespace test::evaluated;
using Eigen::Matrix2Xd;
using Eigen::Matrix3Xd;
using slant::contact::rigid_body_modes;

/// What is left of v outside the columns of R.
double outside(MatrixXd const& R, VectorXd const& v) {
  return (v - R * (R.transpose() * v)).norm() / v.norm();
}

TEST_CASE("translations and rotations about any point, and nothing else") {
  Matrix3Xd nodes(3, 5);
  nodes << 0, 100, 7, 1, 3,  //
      0, 1, -2, 4, 8,        //
      1, 2, 5, 6, -1;
  MatrixXd const R = rigid_body_modes(nodes);
  REQUIRE(R.cols() == 6);
  CHECK((R.transpose() * R - MatrixXd::Identity(6, 6)).norm() <= 1e-14);
  VectorXd turn(15), stretch(15);
  for (int i = 0; i < 5; ++i) {
    turn.segment<3>(3 * i) = Vector3d(1, -2, 3).cross(nodes.col(i) - Vector3d(9, 8, 7));
    stretch.segment<3>(3 * i) = nodes.col(i);
  }
  CHECK(outside(R, turn) <= 1e-14);
  CHECK(outside(R, stretch) >= 0.1);

  Matrix2Xd const flat = nodes.topRows(2);
  MatrixXd const plane = rigid_body_modes(flat);
  REQUIRE(plane.cols() == 3);
  VectorXd spin(10);
  for (int i = 0; i < 5; ++i) spin.segment<2>(2 * i) << 4 - flat(1, i), flat(0, i) + 1;
  CHECK(outside(plane, spin) <= 1e-14);
}

TEST_CASE("nodes on a line do not turn about it, a single one not at all") {
  Matrix3Xd line(3, 4);
  for (int i = 0; i < 4; ++i) line.col(i) = Vector3d(0.1, 0.2, 0.3) * i;
  CHECK(rigid_body_modes(line).cols() == 5);
  CHECK(rigid_body_modes(Matrix3Xd(line.col(1))).cols() == 3);
  for (double const far : {1e3, 1e6}) {
    CHECK(rigid_body_modes(Matrix3Xd(line.array() + far)).cols() == 5);
  }
  for (double const size : {1e-300, 1e308}) {
    CHECK(rigid_body_modes(Matrix3Xd(size * line)).cols() == 5);
    Matrix3Xd corner = size * line;
    corner(0, 3) = 0;
    CHECK(rigid_body_modes(corner).cols() == 6);
  }
  Matrix3Xd axis = Matrix3Xd::Constant(3, 4, 0.7);
  axis.row(1) << 1e6 + 1, 1e6 + 2, 1e6 + 4, 1e6 + 5;
  CHECK(rigid_body_modes(axis).cols() == 5);
  CHECK(rigid_body_modes(Matrix2Xd(2, 1).setOnes()).cols() == 2);
}

TEST_CASE("bad coordinates") {
  CHECK_THROWS_AS(static_cast<void>(rigid_body_modes(MatrixXd(4, 2).setOnes())), slant::bad_input);
  CHECK_THROWS_AS(static_cast<void>(rigid_body_modes(MatrixXd(3, 0))), slant::bad_input);
  MatrixXd nodes = MatrixXd::Ones(3, 2);
  nodes(1, 1) = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(static_cast<void>(rigid_body_modes(nodes)), slant::bad_input);
}

}  // namespace rigid_body_modes_test
