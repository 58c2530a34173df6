// SPDX-License-Identifier: MIT
#include <slant/newton/forcing.hpp>
#include <slant/newton/semismooth_newton.hpp>
#include <slant/testing/archetypes.hpp>

#include <support/testing.hpp>

namespace globalisation_test {

using slant::search_point;

/// The lengths that are tried when trial k leaves the residual residuals[k] of 1, the linear model
/// promising 0; the last one is the accepted length, or 0.
template <class G>
std::vector<double> lengths(G const& g, std::vector<double> const& residuals) {
  search_point<double> p;
  p.residual_before = 1;
  p.length = double(g.first_length());
  std::vector<double> tried;
  for (double residual : residuals) {
    tried.push_back(p.length);
    p.residual = residual;
    if (g.accepts(p)) return tried;
    p.length = g.next_length(p);
    ++p.trial;
    if (p.length == 0) break;
  }
  tried.push_back(0);
  return tried;
}

TEST_CASE("a full step is taken wherever F is finite") {
  CHECK(lengths(slant::full_step{}, {1e6}) == std::vector<double>{1});
  CHECK(lengths(slant::full_step{}, {quiet_nan}) == std::vector<double>{1, 0});
}

TEST_CASE("halving ends at a sufficient decrease") {
  slant::halving_line_search const search{.sufficient = 0.1, .max_halvings = 3};
  CHECK(lengths(search, {0.9}) == std::vector<double>{1});
  CHECK(lengths(search, {0.91, 0.95}) == std::vector<double>{1, 0.5});
  CHECK(lengths(search, {quiet_nan, 2, 0.97}) == std::vector<double>{1, 0.5, 0.25});
  CHECK(lengths(search, {2, 2, 2, 1}) == std::vector<double>{1, 0.5, 0.25, 0.125, 0});
}

TEST_CASE("the decrease asked for is that of an inexact model") {
  slant::halving_line_search const search{.sufficient = 0.5};
  search_point<double> p{.residual = 0.94, .residual_before = 1, .linear_residual = 0.9};
  CHECK(search.accepts(p));
  p.residual = 0.96;
  CHECK(!search.accepts(p));
}

TEST_CASE("a scalar without silent conversions") {
  using S = slant::testing::archetype::scalar;
  static_assert(slant::globalisation<slant::full_step, S>);
  static_assert(slant::globalisation<slant::halving_line_search, S>);
  search_point<S> p{.residual = S(0.5), .residual_before = S(1.0)};
  CHECK(slant::halving_line_search{}.accepts(p));
  CHECK(slant::halving_line_search{}.next_length(p) == S(0.5));
}

TEST_CASE("options are checked by name") {
  CHECK_THROWS_WITH_AS(slant::halving_line_search{.sufficient = 1}.validate(),
                       "sufficient: got 1, expected a number in (0, 1)", slant::bad_input);
  CHECK_THROWS_WITH_AS(slant::halving_line_search{.max_halvings = -1}.validate(),
                       "max_halvings: got -1, expected a number >= 0", slant::bad_input);
}

using slant::forcing_history;

template <class Rule>
std::vector<double> tolerances(Rule const& rule, std::vector<double> const& errors) {
  auto h = forcing_history<double>::starting_at(errors.front());
  std::vector<double> η{h.next(rule)};
  for (std::size_t k = 1; k < errors.size(); ++k) {
    h.record(errors[k]);
    η.push_back(h.next(rule));
    CHECK(h.iteration == slant::index(k));
    CHECK(h.previous_error == errors[k - 1]);
    CHECK(h.first_error == errors.front());
    CHECK(h.last_tolerance == η.back());
  }
  return η;
}

TEST_CASE("fixed") {
  CHECK(tolerances(slant::fixed_forcing{.tolerance = 0.25}, {7, 3, 9}) ==
        std::vector<double>{0.25, 0.25, 0.25});
}

TEST_CASE("adaptive precision: the two terms of the minimum [T §3.4]") {
  // By hand: r_tol = 1/2, c_fact = 3/4, errors relative to 8.
  auto const η = tolerances(slant::adaptive_precision{.r_tol = 0.5, .c_fact = 0.75}, {8, 8, 4, 16});
  CHECK(η == std::vector<double>{0.5, 0.375, 0.25, 0.1875});
  // [T]: errors are relative step sizes already, so tol⁽⁰⁾ = r_tol and later r_tol err.
  forcing_history<double> h;
  slant::adaptive_precision const rule{.r_tol = 0.01, .c_fact = 0.9};
  CHECK(h.next(rule) == 0.01);
  h.record(0.2);
  CHECK(h.next(rule) == doctest::Approx(0.002));
}

TEST_CASE("Eisenstat and Walker: choice 2 and its safeguard") {
  slant::eisenstat_walker const rule{.γ = 0.5, .exponent = 2, .η_max = 0.9, .η_first = 0.75};
  // 0.5 · 0.75² = 0.28 > 0.1 holds the second back; 0.5 · 0.28² = 0.04 does not hold the third.
  auto const η = tolerances(rule, {1, 1e-3, 1e-4, 2e-4});
  CHECK(η[0] == 0.75);
  CHECK(η[1] == 0.5 * 0.75 * 0.75);
  CHECK(η[2] == doctest::Approx(0.5e-2));
  CHECK(η[3] == 0.9);  // an error that grows asks for no accuracy: 0.5 · 4 > η_max
  // Not beyond what is wanted in the end: half of goal · err⁽⁰⁾.
  auto goal = rule;
  goal.goal = 1e-3;
  CHECK(tolerances(goal, {1, 0.5, 2e-3})[2] == 0.25);
}

TEST_CASE("powers without pow") {
  for (double e : {1.0, 1.25, 1.5, 1.618033988749895, 2.0}) {
    for (double t : {1e-12, 0.3, 1.0, 5.0})
      CHECK(slant::detail::power_of(t, e) == doctest::Approx(std::pow(t, e)).epsilon(3e-5));
  }
  CHECK(slant::detail::power_of(0.0, 1.5) == 0);
}

TEST_CASE("a scalar without silent conversions; an error that is NaN") {
  using S = slant::testing::archetype::scalar;
  auto h = forcing_history<S>::starting_at(S(4.0));
  h.record(S(1.0));
  CHECK(h.next(slant::fixed_forcing{.tolerance = 0.5}) == S(0.5));
  CHECK(h.next(slant::adaptive_precision{}) == S(0.1) * S(0.25));
  CHECK(h.next(slant::eisenstat_walker{}) > S(0));
  h.record(std::numeric_limits<S>::quiet_NaN());
  CHECK(h.next(slant::eisenstat_walker{}) == S(0.9));
}

TEST_CASE("options of forcing are checked by name") {
  CHECK_THROWS_WITH_AS(slant::fixed_forcing{.tolerance = 1}.validate(),
                       "tolerance: got 1, expected a number in [0, 1)", slant::bad_input);
  CHECK_THROWS_WITH_AS(slant::adaptive_precision{.r_tol = 0}.validate(),
                       "r_tol: got 0, expected a number in (0, 1)", slant::bad_input);
  CHECK_THROWS_AS(slant::adaptive_precision{.c_fact = std::nan("")}.validate(), slant::bad_input);
  CHECK_THROWS_WITH_AS(slant::eisenstat_walker{.exponent = 3}.validate(),
                       "exponent: got 3, expected a number in (1, 2]", slant::bad_input);
  CHECK_THROWS_AS(slant::eisenstat_walker{.η_first = 0.95}.validate(), slant::bad_input);
  CHECK_THROWS_AS(slant::eisenstat_walker{.goal = 1}.validate(), slant::bad_input);
  CHECK_NOTHROW(slant::eisenstat_walker{}.validate());
}

}  // namespace globalisation_test
