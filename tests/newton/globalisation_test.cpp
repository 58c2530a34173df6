// SPDX-License-Identifier: MIT
#include <slant/newton/globalisation.hpp>
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

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST_CASE("a full step is taken wherever F is finite") {
  CHECK(lengths(slant::full_step{}, {1e6}) == std::vector<double>{1});
  CHECK(lengths(slant::full_step{}, {nan}) == std::vector<double>{1, 0});
  CHECK(lengths(slant::multiple_root{.multiplicity = 3}, {5}) == std::vector<double>{3});
  CHECK(lengths(slant::multiple_root{}, {std::numeric_limits<double>::infinity()}) ==
        std::vector<double>{2, 0});
}

TEST_CASE("halving ends at a sufficient decrease") {
  slant::halving_line_search const search{.sufficient = 0.1, .max_halvings = 3};
  CHECK(lengths(search, {0.9}) == std::vector<double>{1});
  CHECK(lengths(search, {0.91, 0.95}) == std::vector<double>{1, 0.5});
  CHECK(lengths(search, {nan, 2, 0.97}) == std::vector<double>{1, 0.5, 0.25});
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
  static_assert(slant::globalisation<slant::multiple_root, S>);
  static_assert(slant::globalisation<slant::halving_line_search, S>);
  search_point<S> p{.residual = S(0.5), .residual_before = S(1.0)};
  CHECK(slant::halving_line_search{}.accepts(p));
  CHECK(slant::halving_line_search{}.next_length(p) == S(0.5));
}

TEST_CASE("options are checked by name") {
  CHECK_THROWS_WITH_AS(slant::multiple_root{.multiplicity = 0.5}.validate(),
                       "multiplicity: got 0.5, expected a number in [1, ∞)", slant::bad_input);
  CHECK_THROWS_WITH_AS(slant::halving_line_search{.sufficient = 1}.validate(),
                       "sufficient: got 1, expected a number in (0, 1)", slant::bad_input);
  CHECK_THROWS_WITH_AS(slant::halving_line_search{.max_halvings = -1}.validate(),
                       "max_halvings: got -1, expected a number >= 0", slant::bad_input);
}

}  // namespace globalisation_test
