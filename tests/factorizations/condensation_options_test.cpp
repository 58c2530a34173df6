// SPDX-License-Identifier: MIT
#include <slant/factorizations/condensation_options.hpp>

#include <support/testing.hpp>

namespace condensation_options_test {

std::string complaint(slant::condensation_options const& o) {
  return test::complaint([&] { o.validate(); });
}

TEST_CASE("options out of range are named") {
  CHECK(complaint({}) == "nothing thrown");
  CHECK(test::contains(complaint({.levels = -1}), "levels"));
  CHECK(test::contains(complaint({.applications = -1}), "applications"));
  CHECK(test::contains(complaint({.flops_per_second = 0}), "flops_per_second"));
  CHECK(test::contains(complaint({.forming_per_second = -1}), "forming_per_second"));
  CHECK(test::contains(complaint({.bytes_per_second = std::numeric_limits<double>::quiet_NaN()}),
                       "bytes_per_second"));
  CHECK(test::contains(complaint({.cached_per_second = -1}), "cached_per_second"));
  CHECK(test::contains(complaint({.cache = 0}), "cache"));
  CHECK(test::contains(complaint({.most_memory = 0.5}), "most_memory"));
}

TEST_CASE("the fastest plan that fits the memory; the smallest if none does") {
  slant::condensation_options o;
  o.applications = 10;
  o.flops_per_second = o.bytes_per_second = o.cached_per_second = 1;
  auto const plan = [&](double flops, double entries, double tail) {
    slant::condensation_plan p{
        .flops = flops, .entries = entries, .stored = entries + 20, .tail_entries = tail};
    p.predict(o);
    return p;
  };
  std::vector const plans{plan(5000, 300, 10), plan(3000, 200, 20), plan(1000, 100, 60)};
  auto const alone = plan(1000, 80, 0);
  CHECK(plans[0].seconds == 5000 + 10 * 2 * 8 * 10);
  CHECK(plans[0].bytes() == 8 * 320 + 4 * 10);
  o.cache = 1;
  o.most_memory = 4;
  CHECK(&slant::detail::cheapest(plans, alone, o) == &plans[1]);  // 6200 against 6600 and 10600
  o.most_memory = 2;
  CHECK(&slant::detail::cheapest(plans, alone, o) == &plans[2]);
  o.most_memory = 1;
  CHECK(&slant::detail::cheapest(plans, alone, o) == &plans[2]);
  o.cache = 1e6;  // so little that it does not matter
  CHECK(&slant::detail::cheapest(plans, alone, o) == &plans[1]);
}

TEST_CASE("the price of a plan with the inverse, by hand") {
  slant::condensation_options o;
  o.applications = 10;
  o.flops_per_second = o.forming_per_second = o.bytes_per_second = o.cached_per_second = 1;
  slant::condensation_plan const swept{
      .flops = 5000, .stored = 320, .contact = 6, .forming = 240, .tail_entries = 30};
  auto const plan = swept.with_inverse(o);
  CHECK(plan.inverse);
  CHECK(plan.applied() == 18);
  CHECK(plan.bytes() == 8 * 320 + 12 * 18);
  CHECK(plan.seconds == doctest::Approx(5000 + 240 + 10 * 8 * 18));
}

}  // namespace condensation_options_test
