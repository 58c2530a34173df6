// SPDX-License-Identifier: MIT
#include <slant/sets/sets.hpp>

#include <support/testing.hpp>
#include "oracle/precise.hpp"

namespace rotated_test {

using Eigen::Matrix2d;
using slant::block_state;
using slant::rotated;

Matrix2d turn(double angle) {
  Matrix2d q;
  q << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  return q;
}

TEST_CASE("rotated: an ellipse turned by 90 degrees is the ellipse with exchanged axes") {
  slant::ellipse<> const twin{1.0, 3.0};
  Matrix2d q;
  q << 0, -1, 1, 0;
  auto const set = rotated(slant::ellipse<>{3.0, 1.0}, q);
  for (int k = 1; k < 40; ++k) {
    Vector2d const x = 0.2 * k * turn(0.3 * k).col(0);
    CHECK((set.project(x) - twin.project(x)).norm() <= 1e-14);
    CHECK(set.contains(x) == twin.contains(x));
    CHECK((set.slant(x) - twin.slant(x)).norm() <= 1e-13);
    CHECK(set.support(x) == doctest::Approx(twin.support(x)));
    CHECK(set.inequality(x)(0) == doctest::Approx(twin.inequality(x)(0)));
    CHECK((set.inequality_gradient(x) - twin.inequality_gradient(x)).norm() <= 1e-13);
    Eigen::Matrix<double, 1, 1> const ν(2.0);
    CHECK((set.inequality_hessian(x, ν) - twin.inequality_hessian(x, ν)).norm() <= 1e-13);
    Vector2d const p = set.project(x);
    CHECK(set.state(p) == twin.state(twin.project(x)));
    CHECK(set.step_to_boundary(0.5 * p, x) == doctest::Approx(twin.step_to_boundary(0.5 * p, x)));
  }
}

TEST_CASE("rotated: a flat ellipse at any angle contains its projections") {
  slant::ellipse<> const flat{1.0, 1e-6};
  for (int k = 0; k < 60; ++k) {
    auto const set = rotated(flat, turn(0.11 * k));
    Vector2d const x = turn(0.37 * k) * Vector2d(2, 1);
    Vector2d const p = set.project(x);
    CHECK(set.contains(p));
    CHECK(set.state(p) == block_state::sliding);
    Matrix2d const g = set.slant(x);
    CHECK(g == g.transpose());
  }
}

TEST_CASE("rotated: a square on its corner") {
  auto const box = slant::cartesian(slant::interval<>{}, slant::interval<>{});
  auto const set = rotated(box, turn(std::acos(-1.0) / 4));
  double const corner = std::sqrt(2.0);
  CHECK((set.project(Vector2d(3, 0)) - Vector2d(corner, 0)).norm() <= 1e-15);
  CHECK((set.project(Vector2d(2, 2)) - Vector2d(corner / 2, corner / 2)).norm() <= 1e-15);
  CHECK(!set.contains(Vector2d(0.99, 0.99)));
  CHECK(set.contains(Vector2d(0.7, 0.7)));
  static_assert(!slant::has_visit<decltype(set)>);
}

TEST_CASE_TEMPLATE("rotated: other scalars, and powers", S, float, oracle::float_50) {
  Eigen::Matrix<S, 2, 2> q;
  q << S(3) / S(5), S(-4) / S(5), S(4) / S(5), S(3) / S(5);
  auto const set = slant::power(rotated(slant::ellipse<S>{S(2), S(1)}, q), 2);
  Eigen::Matrix<S, Eigen::Dynamic, 1> x(4);
  x << S(3) * q(0, 0), S(3) * q(1, 0), S(0), S(0);
  auto const p = slant::project(set, x);
  S const tolerance = S(16) * std::numeric_limits<S>::epsilon();
  CHECK((p.template head<2>() - S(2) * q.col(0)).norm() <= tolerance);
  CHECK(set.contains(p));
}

TEST_CASE("rotated: a matrix that is not orthogonal is refused") {
  CHECK_THROWS_WITH_AS(static_cast<void>(rotated(slant::ball<2>{}, 2 * Matrix2d::Identity())),
                       "Q: got max |QᵀQ − I| = 3, expected an orthogonal matrix", slant::bad_input);
  Matrix2d q = turn(1.0);
  q(0, 1) = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(static_cast<void>(rotated(slant::ball<2>{}, q)), slant::bad_input);
  CHECK_THROWS_AS(static_cast<void>(rotated(slant::ball<2>{}, (1 + 1e-12) * turn(1.0))),
                  slant::bad_input);
}

}  // namespace rotated_test
