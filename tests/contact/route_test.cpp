// SPDX-License-Identifier: MIT
#include <slant/contact/route.hpp>

#include <fem/steel_brick.hpp>
#include <support/testing.hpp>

namespace route_test {

using slant::contact::choose_route;
using slant::contact::route_costs;
using slant::contact::solution_route;
std::optional<std::string> const possible = std::nullopt;

TEST_CASE("small problems are factored, large ones iterated, and both ways the reason is told") {
  auto const s = fem::make_steel_brick({.k = 1});
  auto const small = choose_route(s.K, possible);
  CHECK(small.route == solution_route::factor);
  CHECK(small.factor_seconds < small.iterate_seconds);
  CHECK(small.reason.starts_with("factored: factors are estimated at "));
  auto const large =
      choose_route(s.K, possible, solution_route::automatic, {.operation = 1});  // seconds
  CHECK(large.route == solution_route::iterate);
  CHECK(large.reason.starts_with("iterated: factors are estimated at more than "));
}

TEST_CASE("without supernodes iterating pays earlier") {
  auto const s = fem::make_steel_brick({.k = 5});
  auto const with = [&](route_costs const& costs) {
    return choose_route(s.K, possible, solution_route::automatic, costs);
  };
  auto const plain = with(route_costs::without_cholmod()), blocked = with({});
  CHECK(plain.factor_seconds > blocked.factor_seconds);
  CHECK(plain.iterate_seconds == blocked.iterate_seconds);
}

TEST_CASE("the choice can be forced, but not to what is impossible") {
  auto const s = fem::make_steel_brick({.k = 2});
  for (auto const route : {solution_route::factor, solution_route::iterate}) {
    auto const c = choose_route(s.K, possible, route);
    CHECK(c.route == route);
    CHECK(c.reason.ends_with("as asked for"));
  }
  std::optional<std::string> const refusal = "the nodes are shy";
  auto const c = choose_route(s.K, refusal);
  CHECK(c.route == solution_route::factor);
  CHECK(c.reason == "factored: the nodes are shy");
  CHECK(test::complaint([&] {
          static_cast<void>(choose_route(s.K, refusal, solution_route::iterate));
        }) == "route: got iterate, expected factor or automatic, because the nodes are shy");
}

}  // namespace route_test
