// SPDX-License-Identifier: MIT
#include <slant/base/report.hpp>
#include <slant/contact/route.hpp>

#include <fem/steel_brick.hpp>

#include <initializer_list>
#include <support/testing.hpp>

namespace route_test {

using slant::contact::choose_route;
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
  CHECK(SLANT_COMPLAINT(choose_route(s.K, refusal, solution_route::iterate)) ==
        "route: got iterate, expected factor or automatic, because the nodes are shy");
}

/// A result with that error, converged below 1e-8.
struct found {
  struct {
    double value;
    [[nodiscard]] double relative() const { return value; }
  } error;
  std::string reason;
  slant::status status = slant::status::stalled;
  slant::work work{.operator_applications = 10};
  double condition = 0;
  slant::index solves = 1;
  [[nodiscard]] bool converged() const { return error.value <= 1e-8; }
};

TEST_CASE("the other route follows where one gets nowhere, and the nearer result is told") {
  struct run {
    solution_route begin;
    double first, second;  // errors; −1: refused, −2: no memory
    double expected;
    char const* reason;
  };
  auto const factor = solution_route::factor, iterate = solution_route::iterate;
  for (run const& r : std::initializer_list<run>{
           {factor, 1e-9, 0, 1e-9, "why"},
           {factor, 1e-8 * 1.1, 0, 1e-8 * 1.1, "why"},  // near
           {factor, 1, 1e-9, 1e-9, "why; iterated after all: first"},
           {factor, 1, 0.5, 0.5, "why; iterated after all: first"},
           {factor, 1, 2, 1, "why; iterated in vain: second"},
           {factor, 1, quiet_nan, 1, "why; iterated in vain: second"},
           {factor, 1, -1, 1, "why; iterated in vain"},
           {factor, infinity, 0, infinity, "why"},  // unbounded
           {iterate, 1, infinity, infinity, "why; factored after all: first"},
           {iterate, 1e-9, 0, 1e-9, "why"},
           {iterate, 1e-8 * 1.1, 0, 0, "why; factored after all: first"},
           {iterate, 1, 2, 1, "why; factored in vain: second"},
           {iterate, 1, -2, 1, "why; factored in vain"},
           {factor, -2, 2, 2, "why; iterated after all: no memory"},
           {iterate, -1, 2, 2, "why; factored after all: K: got first, expected another"}}) {
    slant::contact::route_choice choice{.route = r.begin, .reason = "why"};
    auto const attempt = [&](double error, std::string name) {
      if (error == -1) throw slant::bad_input("K", name, "another");
      if (error == -2) throw std::bad_alloc();
      found f{{error}, name, error == infinity ? slant::status::unbounded : slant::status::stalled};
      f.condition = name == "second" ? 7 : 0;
      return f;
    };
    int calls = 0;
    auto const result = slant::contact::detail::by_routes(
        choice, true, [&] { return attempt(r.first, "first"); },
        [&] {
          ++calls;
          return slant::contact::detail::unless_refused(
              [&] { return attempt(r.second, "second"); });
        });
    CAPTURE(choice.reason);
    CHECK(result.error.value == r.expected);
    CHECK(choice.reason == r.reason);
    CHECK((choice.route == r.begin) == (r.expected == r.first));
    bool const is_sum = calls == 1 && r.first >= 0 && !(r.second < 0);
    CHECK(result.work.operator_applications == (is_sum ? 20 : 10));
    CHECK(result.solves == (is_sum ? 2 : 1));
    CHECK((result.condition == 7) == (calls == 1 && !(r.second < 0)));
  }
  // Not asked for, or refused everywhere.
  slant::contact::route_choice choice{.route = iterate, .reason = {}};
  auto const refused = [](char const* name) {
    return [name]() -> found { throw slant::bad_input(name, "a", "b"); };
  };
  auto const complaint = [&](bool may_change) {
    return test::complaint([&] {
      static_cast<void>(slant::contact::detail::by_routes(
          choice, may_change, refused("first"),
          [&] { return slant::contact::detail::unless_refused(refused("second")); }));
    });
  };
  CHECK(complaint(false).starts_with("first"));
  CHECK(complaint(true).starts_with("first"));
}

TEST_CASE("factors that follow get nowhere either: iterated to the end, if that was cut short") {
  auto const s = fem::make_steel_brick({.k = 1});
  for (slant::index const cycles : {0, 1 << 29, 1 << 30}) {
    slant::contact::route_choice choice{
        .route = solution_route::iterate, .factor_seconds = 1e-9, .reason = {}};
    slant::contact::detail::route_budget<double> budget(s.K, choice, {});
    CHECK(budget.is_spent(cycles) == (cycles > 0));
    auto const after = slant::contact::detail::factored_after(
        choice, budget,
        [&] {
          return cycles == 1 << 29 ? found{{0.5}, {}} : throw std::bad_alloc();
        },
        [&] {
          return found{{budget.is_spent(cycles) ? 1.0 : 0.0}, {}};
        });
    REQUIRE(after.has_value() == (cycles > 0));
    CHECK((!after || after->converged()));
    CHECK(choice.route == solution_route::iterate);
  }
}

}  // namespace route_test
