// SPDX-License-Identifier: MIT
#include <slant/sets/free_space.hpp>
#include <slant/sets/point.hpp>

#include <support/testing.hpp>
#include "oracle/precise.hpp"

namespace point_test {

TEST_CASE_TEMPLATE("point: known answers", S, float, oracle::float_50) {
  using vec = Eigen::Matrix<S, 2, 1>;
  slant::point<2, S> const origin;
  vec const x(S(1), S(-2)), p(S(3), S(0.5)), none(S(0), S(0));
  CHECK(origin.project(x) == none);
  auto const set = origin.with(p);
  CHECK(set.position() == p);
  CHECK(set.project(x) == p);
  CHECK(set.contains(p));
  CHECK_FALSE(set.contains(x));
  CHECK(set.state(p) == slant::block_state::fixed);
  CHECK(set.slant(p) == Eigen::Matrix<S, 2, 2>::Zero());
  CHECK(set.step_to_boundary(p, x) == S(0));
  CHECK(set.step_to_boundary(p, none) == std::numeric_limits<S>::infinity());
  CHECK(set.support(x) == S(2));
}

TEST_CASE("point: membership is relative to the size of the point") {
  for (double scale : {1e-300, 1e-150, 1.0, 1e150, 1e300}) {
    Vector2d const p(3 * scale, -4 * scale), off(scale, scale);
    slant::point<2> const set(p);
    CHECK(set.contains(p + 8e-16 * off));
    CHECK_FALSE(set.contains(p + 9e-14 * off));
  }
  slant::point<2> const origin;
  CHECK(origin.contains(Vector2d(0, 0)));
  CHECK_FALSE(origin.contains(Vector2d(0, 5e-324)));
}

TEST_CASE_TEMPLATE("free space: everything is inside", S, float, long double) {
  slant::free_space<3, S> const space;
  Eigen::Matrix<S, 3, 1> const x(S(1), S(-2), S(0.5)), d(S(0), S(1), S(0));
  CHECK(space.project(x) == x);
  CHECK(space.with().project(x + x) == x + x);
  CHECK(space.contains(x));
  CHECK(space.state(x) == slant::block_state::free);
  CHECK(space.slant(x) == Eigen::Matrix<S, 3, 3>::Identity());
  CHECK(space.step_to_boundary(x, d) == std::numeric_limits<S>::infinity());
  CHECK(space.support(x) == std::numeric_limits<S>::infinity());
  CHECK(space.support(S(0) * x) == S(0));
}

TEST_CASE("free space: no inequality, an empty one for those who loop over them") {
  slant::free_space<2> const space;
  static_assert(slant::free_space<2>::inequalities == 0);
  Vector2d const x(1, 2);
  CHECK(space.inequality(x).size() == 0);
  CHECK(space.inequality_gradient(x).rows() == 2);
  CHECK(space.inequality_gradient(x).cols() == 0);
  CHECK(space.inequality_hessian(x, Eigen::Matrix<double, 0, 1>{}) == Eigen::Matrix2d::Zero());
}

}  // namespace point_test
