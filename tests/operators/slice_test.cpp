// SPDX-License-Identifier: MIT
#include <slant/operators/operators.hpp>
#include <slant/testing/archetypes.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>

namespace slice_test {

TEST_CASE("consecutive components, and back among zeros") {
  auto const s = slant::slice(5, 1, 3);
  CHECK(s.rows() == 3);
  CHECK(s.cols() == 5);
  VectorXd const x{{1, 2, 3, 4, 5}};
  VectorXd y(3), back(5);
  slant::apply(s, x, y);
  CHECK(y == VectorXd{{2, 3, 4}});
  slant::apply_adjoint(s, y, back);
  CHECK(back == VectorXd{{0, 2, 3, 4, 0}});
  slant::no_workspace none;
  slant::apply_add(s, 2.0, x, y, none);
  CHECK(y == VectorXd{{6, 9, 12}});
  slant::apply_adjoint_add(s, -1.0, y, back, none);
  CHECK(back == VectorXd{{0, -4, -6, -8, 0}});
  s.segment(back).setConstant(7);
  CHECK(back == VectorXd{{0, 7, 7, 7, 0}});
  slant::testing::check_operator_laws(s);
}

TEST_CASE("a product passes the segment on; nothing allocates") {
  MatrixXd const a{{1, 2, 3}, {4, 5, 6}};
  auto const p = slant::product(a, slant::slice(5, 1, 3));
  VectorXd const x{{1, 2, 3, 4, 5}};
  VectorXd y(2);
  auto w = slant::workspace(p, x);
  slant::testing::allocation_guard const guard;
  slant::apply(p, x, y, w);
  slant::apply_add(p, 1.0, x, y, w);
  auto const allocations = guard.count();
  CHECK(allocations == 0);
  CHECK(y == VectorXd(2 * a * x.segment(1, 3)));
  slant::testing::check_operator_laws(p);
}

TEST_CASE("other vectors than Eigen's") {
  using slant::testing::archetype::vector;
  MatrixXd const a{{1, 2, 3}, {4, 5, 6}};
  auto const p = slant::product(a, slant::slice(5, 1, 3));
  vector const x(VectorXd{{1, 2, 3, 4, 5}});
  vector y(VectorXd::Zero(2));
  slant::apply(p, x, y);
  CHECK(y.local() == VectorXd{{20, 47}});
}

TEST_CASE("bad input") {
  CHECK_THROWS_WITH_AS(static_cast<void>(slant::slice(5, 6, 0)),
                       "first: got 6, expected a number in [0, 5]", slant::bad_input);
  CHECK_THROWS_WITH_AS(static_cast<void>(slant::slice(5, 2, 4)),
                       "count: got 4, expected a number in [0, 3]", slant::bad_input);
  CHECK_THROWS_AS(static_cast<void>(slant::slice(-1, 0, 0)), slant::bad_input);
}

}  // namespace slice_test
