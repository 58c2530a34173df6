// SPDX-License-Identifier: MIT
#include <slant/sets/free_space.hpp>

#include <support/testing.hpp>

namespace free_space_test {

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

}  // namespace free_space_test
