// SPDX-License-Identifier: MIT
//
// The sets compute with the least that is a scalar, and get what they get with double.
#include <slant/sets/ball.hpp>
#include <slant/sets/ellipse.hpp>
#include <slant/sets/free_space.hpp>
#include <slant/sets/half_line.hpp>
#include <slant/sets/interval.hpp>
#include <slant/sets/second_order_cone.hpp>
#include <slant/testing/archetypes.hpp>

#include <doctest/doctest.h>

namespace sets_archetypes_test {

using S = slant::testing::archetype::scalar;

template <class C, class D>
void compare(C const& strict, D const& plain) {
  constexpr int n = D::dimension;
  Eigen::Matrix<double, n, 1> x, d;
  Eigen::Matrix<S, n, 1> X, direction;
  for (int i = 0; i < n; ++i) {
    x[i] = 1.5 + i;
    d[i] = -1.0 + i;
    X[i] = S(x[i]);
    direction[i] = S(d[i]);
  }
  Eigen::Matrix<double, n, 1> const p = plain.project(x);
  Eigen::Matrix<S, n, 1> const P = strict.project(X);
  Eigen::Matrix<double, n, n> const g = plain.slant(x);
  Eigen::Matrix<S, n, n> const G = strict.slant(X);
  for (int i = 0; i < n; ++i) {
    CHECK(P[i].value() == p[i]);
    for (int j = 0; j < n; ++j) CHECK(G(i, j).value() == g(i, j));
  }
  CHECK(strict.contains(P) == plain.contains(p));
  CHECK(strict.state(P) == plain.state(p));
  CHECK(strict.step_to_boundary(P, direction).value() == plain.step_to_boundary(p, d));
  CHECK(strict.support(X).value() == plain.support(x));
}

TEST_CASE("sets of the least that is a scalar") {
  compare(slant::ball<2, S>{S(1)}, slant::ball<2>{1.0});
  compare(slant::ellipse<S>{S(1), S(2)}, slant::ellipse<>{1.0, 2.0});
  compare(slant::second_order_cone<3, S>{S(1)}, slant::second_order_cone<3>{1.0});
  compare(slant::half_line<S>{S(1)}, slant::half_line<>{1.0});
  compare(slant::interval<S>{S(0), S(1)}, slant::interval<>{0.0, 1.0});
  compare(slant::free_space<2, S>{}, slant::free_space<2>{});
}

}  // namespace sets_archetypes_test
