// SPDX-License-Identifier: MIT
#include <slant/contact/solve_obstacle.hpp>

#include <fem/steel_brick.hpp>

#include <doctest/doctest.h>

namespace obstacle_route_test {

using slant::contact::choose_route;
using slant::contact::obstacle_route;
using sparse = Eigen::SparseMatrix<double>;

TEST_CASE("small problems are factored, large ones iterated, and both ways the reason is told") {
  auto const s = fem::make_steel_brick({.k = 2});
  auto const small = choose_route(s.K, s.N);
  CHECK(small.route == obstacle_route::factor);
  CHECK(small.factor_seconds < small.iterate_seconds);
  CHECK(small.reason.starts_with("factored: factors are estimated at "));
  slant::contact::route_costs slow;
  slow.operation = 1;  // seconds
  auto const large = choose_route(s.K, s.N, obstacle_route::automatic, slow);
  CHECK(large.route == obstacle_route::iterate);
  CHECK(large.reason.starts_with("iterated: factors are estimated at more than "));
}

TEST_CASE("without supernodes iterating pays earlier") {
  auto const s = fem::make_steel_brick({.k = 5});
  auto const costs = slant::contact::route_costs::without_cholmod();
  auto const plain = choose_route(s.K, s.N, obstacle_route::automatic, costs);
  auto const blocked =
      choose_route(s.K, s.N, obstacle_route::automatic, slant::contact::route_costs{});
  CHECK(plain.factor_seconds > blocked.factor_seconds);
  CHECK(plain.iterate_seconds == blocked.iterate_seconds);
}

TEST_CASE("the choice can be forced, but not to what is impossible") {
  auto const s = fem::make_steel_brick({.k = 2});
  for (auto const route : {obstacle_route::factor, obstacle_route::iterate}) {
    auto const c = choose_route(s.K, s.N, route);
    CHECK(c.route == route);
    CHECK(c.reason.ends_with("as asked for"));
  }
  sparse const shared = Eigen::MatrixXd::Ones(2, s.K.cols()).sparseView();
  auto const c = choose_route(s.K, shared);
  CHECK(c.route == obstacle_route::factor);
  CHECK(c.reason == "factored: rows 0 and 1 of N share unknown 0");
  CHECK_THROWS_AS((void)choose_route(s.K, shared, obstacle_route::iterate), slant::bad_input);
}

}  // namespace obstacle_route_test
