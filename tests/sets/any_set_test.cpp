// SPDX-License-Identifier: MIT
#include <slant/sets/sets.hpp>

#include <krylov/spd_matrices.hpp>
#include <support/testing.hpp>

namespace any_set_test {

using slant::any_set;

/// One run of every kind.
auto all_kinds() {
  return slant::cartesian(
      slant::half_lines(2), slant::half_lines(VectorXd{{-1.0, 0.5, -infinity}}),
      slant::intervals(VectorXd{{-1.0, 0.0}}, VectorXd{{1.0, infinity}}),
      slant::intervals(VectorXd{{1.0, 0.0}}), slant::free_components(2),
      slant::discs(VectorXd{{1.0, 0.0, infinity}}),
      slant::discs<slant::planar>(VectorXd{{1.0, 0.3}}), slant::power(slant::ball<3>{2.0}, 2),
      slant::power(slant::ellipse<>{2.0, 0.5}, 2), slant::friction_cones<2>(VectorXd{{0.3, 1.0}}),
      slant::friction_cones<3>(VectorXd{{0.3}}));
}

static_assert(!std::is_constructible_v<any_set<>, slant::ball<2, float>>);
static_assert(!std::is_constructible_v<any_set<>, slant::ball<4>>);
static_assert(!std::is_constructible_v<any_set<>, slant::point<1>>);
static_assert(!std::is_constructible_v<any_set<>, decltype(slant::shifted(slant::half_lines(2),
                                                                          VectorXd{{1.0, 2.0}}))>);
static_assert(slant::convex_set<any_set<float>, Eigen::VectorXf>);

TEST_CASE("any_set: every answer has the bits of the set that it was made of") {
  auto const given = all_kinds();
  any_set const set(given);
  static_assert(std::same_as<decltype(set), any_set<double> const>);
  Eigen::Index const n = given.size();
  CHECK(set.size() == n);
  CHECK(set.block_count() == given.block_count());
  for (unsigned seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    VectorXd const z = 2 * test::random_vector(n, seed), d = test::random_vector(n, seed + 50);
    VectorXd const x = slant::project(set, z);
    CHECK(x == slant::project(given, z));
    VectorXd in_place = z;
    slant::project(set, in_place, in_place);
    CHECK(in_place == x);
    CHECK(set.contains(x));
    CHECK(set.contains(z) == given.contains(z));
    CHECK(set.support(d) == given.support(d));
    for (double const enough : {0.0, 0.1, 10.0})
      CHECK(set.step_to_boundary(x, d, enough) == given.step_to_boundary(x, d, enough));
    auto const g = set.slant(z);
    auto const expected = given.slant(z);
    VectorXd y(n), other(n);
    g.apply(d, y);
    expected.apply(d, other);
    CHECK(y == other);
    g.apply_add(0.5, x, y);
    expected.apply_add(0.5, x, other);
    CHECK(y == other);
    g.diagonal(y);
    expected.diagonal(other);
    CHECK(y == other);
    slant::curved_face<> face(set), same(given);
    face.assign(set, z, 0.7);
    same.assign(given, z, 0.7);
    face.weigh(d, y);
    same.weigh(d, other);
    CHECK(y == other);
  }
}

TEST_CASE("any_set: visits blocks where they are, numbered through") {
  auto const given = all_kinds();
  any_set const set(given);
  auto const places_of = [](auto const& s) {
    std::vector<double> places;
    s.visit([&](auto const& block, auto const& p) {
      places.push_back(double(p.index()));
      for (slant::index j = 0; j < p.size(); ++j) places.push_back(double(p.component(j)));
      if constexpr (requires { block.radius(); }) places.push_back(block.radius());
    });
    return places;
  };
  CHECK(places_of(set) == places_of(given));
}

TEST_CASE("any_set: of few kinds, where no more are needed") {
  using forces = any_set<double, slant::contact_runs<double>>;
  static_assert(!std::is_constructible_v<forces, decltype(all_kinds())>);
  auto const given = slant::cartesian(slant::half_lines(2), slant::discs(VectorXd{{1.0, 0.5}}));
  forces const set(given);
  VectorXd const z = 2 * test::random_vector(6, 5);
  CHECK(slant::project(set, z) == slant::project(given, z));
}

TEST_CASE("any_set: of a single block, of nothing, of itself") {
  any_set const disc(slant::ball<2>{2.0});
  CHECK(disc.size() == 2);
  CHECK(slant::project(disc, VectorXd{{3.0, 4.0}}).norm() == doctest::Approx(2));
  any_set<> const empty;
  CHECK(empty.size() == 0);
  CHECK(empty.contains(VectorXd(0)));
  any_set<> const copy = disc;
  CHECK(copy.contains(VectorXd{{2.0, 0.0}}));
  CHECK_FALSE(copy.contains(VectorXd{{2.0, 0.0, 0.0}}));
}

TEST_CASE("any_set: nothing allocates but the constructor and slant(x)") {
  any_set const set(all_kinds());
  VectorXd const z = 2 * test::random_vector(set.size(), 3), d = test::random_vector(set.size(), 4);
  VectorXd x(set.size()), y(set.size());
  auto g = set.slant(z);
  slant::testing::allocation_guard const guard;
  set.project(z, x);
  bool const inside = set.contains(x);
  double const step = set.step_to_boundary(x, d);
  double const support = set.support(d);
  set.slant(d, g);
  g.apply(z, y);
  auto const allocations = guard.count();
  CHECK(allocations == 0);
  CHECK(inside);
  CHECK(step >= 0);
  CHECK(support >= 0);
  VectorXd other(set.size());
  set.slant(d).apply(z, other);
  CHECK(y == other);
}

}  // namespace any_set_test
