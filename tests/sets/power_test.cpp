// SPDX-License-Identifier: MIT
#include <slant/sets/sets.hpp>
#include <slant/testing/archetypes.hpp>

#include <support/testing.hpp>
#include "counting_disc.hpp"
#include "oracle/precise.hpp"

namespace power_test {

using namespace products;
using slant::planar;
using slant::power;

TEST_CASE("power: the step stops early, and then still tells that a step would leave the set") {
  vec<> const g = vec<>::Ones(100);
  auto const set = power(counting_disc{}, g);
  vec<> const x = vec<>::Zero(200);
  vec<> d = vec<>::Constant(200, 1e-3);
  d[2] = 100;  // the second disc is left at about 0.01
  counting_disc::questions = 0;
  double const full = set.step_to_boundary(x, d);
  CHECK(full == doctest::Approx(0.01));
  CHECK(counting_disc::questions == 100);
  counting_disc::questions = 0;
  CHECK(set.step_to_boundary(x, d, 1.0) < 1.0);
  CHECK(counting_disc::questions == 2);
  counting_disc::questions = 0;
  CHECK(set.step_to_boundary(x, d, 0.001) == full);
  CHECK(counting_disc::questions == 100);
  vec<> y = x;
  y[0] = 1;
  d[0] = 1;
  counting_disc::questions = 0;
  CHECK(set.step_to_boundary(y, d) == 0.0);
  CHECK(counting_disc::questions == 1);
  y[0] = std::numeric_limits<double>::quiet_NaN();
  CHECK(std::isnan(set.step_to_boundary(y, d)));
  y[0] = 0;
  d[198] = std::numeric_limits<double>::quiet_NaN();
  CHECK(std::isnan(set.step_to_boundary(y, d)));
}

TEST_CASE("power: no member allocates, slant(x) excepted") {
  vec<> const g = numbers(20, 8).cwiseAbs();
  auto const set = power<planar>(slant::ball<2>{}, g);
  vec<> const x = numbers(40, 9);
  vec<> y = x;
  slant::testing::allocation_guard const guard;
  set.project(x, y);
  set.project(y, y);
  bool const inside = set.contains(y);
  double const step = set.step_to_boundary(y, x);
  double const support = set.support(x);
  auto const kept = guard.count();
  auto operator_g = set.slant(y);
  slant::testing::allocation_guard const again;
  set.slant(x, operator_g);
  auto const allocations = kept + again.count();
  CHECK(allocations == 0);
  CHECK(inside);
  CHECK(step >= 0);
  CHECK(support > 0);
}

TEST_CASE("power: free components are neither looked at nor stored") {
  auto const set = power(slant::free_space<1>{}, 3);
  static_assert(sizeof(set) <= 2 * sizeof(slant::index));
  vec<> const nan = vec<>::Constant(3, std::numeric_limits<double>::quiet_NaN());
  vec<> const x = Vector3d(1, -2, 3);
  CHECK(slant::project(set, x) == x);
  CHECK(set.contains(x));
  CHECK(!set.contains(nan));
  CHECK(set.step_to_boundary(x, x) == infinity);
  CHECK(set.support(vec<>(vec<>::Zero(3))) == 0.0);
  CHECK(set.support(x) == infinity);
  auto const g = set.slant(x);
  vec<> y = nan;
  g.apply(x, y);
  CHECK(y == x);
}

TEST_CASE("power: sizes that do not match are not members") {
  auto const set = power(slant::half_line<>{}, 3);
  CHECK(set.contains(vec<>(vec<>::Ones(3))));
  CHECK(!set.contains(vec<>(vec<>::Ones(2))));
  // Nor points, directions, or forces.
  auto const product = slant::cartesian(set, slant::half_lines(2));
  VectorXd const few = VectorXd::Ones(4), x = VectorXd::Ones(5);
  auto const refuses = [&](auto const& Λ) {
    CHECK_THROWS_AS((void)Λ.step_to_boundary(few, x), slant::bad_input);
    CHECK_THROWS_AS((void)Λ.step_to_boundary(x, few), slant::bad_input);
    CHECK_THROWS_AS((void)Λ.slant(few), slant::bad_input);
    CHECK_THROWS_AS((void)slant::face(Λ, few), slant::bad_input);
    CHECK(SLANT_COMPLAINT(slant::function_value(slant::support(Λ), few)) ==
          "x: got 4 rows, expected 5 (the dimension of the function)");
  };
  refuses(power(slant::half_line<>{}, 5));
  refuses(product);
  refuses(slant::any_set<double>(product));
}

TEST_CASE("power: expressions and vectors that are no Eigen vectors") {
  vec<> const g = numbers(4, 10).cwiseAbs();
  vec<> const x = numbers(8, 11);
  vec<> const h = numbers(8, 12);
  auto const set = power(slant::ball<2>{}, g);
  vec<> y(8);
  set.project(x - h, y);
  CHECK(y == slant::project(set, vec<>(x - h)));
  CHECK(set.contains(0.5 * y));
  slant::testing::archetype::vector v(x);
  slant::project(set, v, v);
  CHECK(v.local() == slant::project(set, x));
  CHECK(slant::project(set, slant::testing::archetype::vector(x)).local() == v.local());
  CHECK(set.contains(v));
  CHECK(set.step_to_boundary(v, v) == set.step_to_boundary(v.local(), v.local()));
  static_assert(slant::convex_set<decltype(set), slant::testing::archetype::vector>);
  static_assert(slant::separable_set<decltype(set), slant::testing::archetype::vector>);
}

TEST_CASE("power: copies of one block, and parameters that are lists or one number for all") {
  auto const copies = power(slant::half_line<>{2.0}, 3);
  CHECK(slant::project(copies, vec<>(vec<>::Zero(3))) == vec<>::Constant(3, 2.0));
  CHECK(power(slant::half_line<>{}, 0).size() == 0);
  std::vector<double> const upper{1, 2, 3};
  auto const boxes = power(slant::interval<>{}, 0.0, upper);
  CHECK(slant::project(boxes, vec<>(vec<>::Constant(3, 9.0))) == Vector3d(1, 2, 3));
  CHECK(slant::project(boxes, vec<>(vec<>::Constant(3, -9.0))) == Vector3d(0, 0, 0));
  auto const ellipses = power(slant::ellipse<>{1.0, 1.0}, vec<>(vec<>::Ones(2)), 2.0);
  CHECK(ellipses.block(1).project(Vector2d(0, 9))(1) == doctest::Approx(2.0));
  auto const ints = power(slant::half_line<>{}, std::vector<int>{1, 2});
  CHECK(ints.block(1).lower() == 2.0);
}

TEST_CASE("power: update changes the parameters without allocation") {
  vec<> g = vec<>::Ones(50);
  auto set = power(slant::ball<2>{}, g);
  g.setConstant(2.0);
  CHECK(test::allocations_of([&] { set.update(g); }) == 0);
  CHECK(set.block(49).radius() == 2.0);
}

TEST_CASE("power: of a function it is the sum, in both layouts, and allocates once") {
  auto const φ = slant::support(slant::ball<2>{0.7});
  auto const three = power(φ, 3);
  auto const planes = power<planar>(φ, 3);
  auto const sum = slant::separable_sum(φ, φ, φ);
  vec<> const z = numbers(6, 4), v = z / 10;
  vec<> x(6), y(6), mixed(6);
  three.prox(0.5, z, x);
  sum.prox(0.5, z, y);
  CHECK(x == y);
  CHECK(three.value(z) == sum.value(z));
  CHECK(three.conjugate(v) == sum.conjugate(v));
  CHECK(three.conjugate(z) == infinity);
  CHECK_THROWS_AS(static_cast<void>(three.slant(1.0, vec<>(z.head(5)))), slant::bad_input);
  CHECK_THROWS_AS(static_cast<void>(sum.slant(1.0, vec<>(z.head(5)))), slant::bad_input);
  for (int i = 0; i < 6; ++i) mixed[i] = z[i / 3 + 2 * (i % 3)];
  planes.prox(0.5, mixed, mixed);
  for (int i = 0; i < 6; ++i) CHECK(mixed[i] == x[i / 3 + 2 * (i % 3)]);
  auto g = three.slant(0.5, z);
  auto const of_sum = sum.slant(0.5, v);
  CHECK(test::allocations_of([&] { three.slant(0.5, v, g); }) == 0);
  vec<> by_power(6), by_sum(6);
  g.apply(z, by_power);
  of_sum.apply(z, by_sum);
  CHECK(by_power == by_sum);
}

/// ½ x² on a line, which ends at 9: a set as well.
struct in_place {
  static constexpr int dimension = 1;
  using point = Eigen::Matrix<double, 1, 1>;
  void prox(double ρ, point const& z, point& x) const { x = z / (1 + ρ); }
  [[nodiscard]] double value(point const& x) const { return x[0] * x[0] / 2; }
  [[nodiscard]] point project(point const& x) const { return x.cwiseMin(9.0); }
  [[nodiscard]] bool contains(point const& x) const { return x[0] <= 9; }
};

TEST_CASE(
    "power: what has prox is a function; support functions take the parameters of their sets") {
  auto const φ = power(in_place{}, 2);
  static_assert(!slant::set_part<decltype(φ)>);
  vec<> const z = Vector2d(30, -4);
  CHECK(slant::prox(φ, 1.0, z) == z / 2);
  CHECK(slant::prox(slant::separable_sum(φ, in_place{}), 1.0, vec<>(vec<>::Ones(3))) ==
        vec<>::Constant(3, 0.5));
  auto norms = power(slant::support(slant::ball<2>{}), Vector2d(3, 0.5));
  CHECK(norms.value(vec<>(vec<>::Ones(4))) == doctest::Approx(3.5 * std::sqrt(2.0)));
  CHECK(SLANT_COMPLAINT(norms.update(Vector2d(3, -1))) ==
        "radius[1]: got -1, expected a number >= 0");
  auto const pairs = power(slant::support(slant::half_line<>{} * slant::ball<2>{}), 2);
  slant::visit_block(pairs, 3, [](auto const& block, auto const& p) {
    CHECK(p.component(0) == 4);
    CHECK(slant::dimension_of(block) == 2);
  });
}

TEST_CASE("power: bad parameters are named with their block, and change nothing") {
  vec<> g = vec<>::Ones(5);
  auto set = power(slant::ball<2>{}, g);
  g[0] = 7;
  g[3] = -1;
  CHECK(SLANT_COMPLAINT(set.update(g)) == "radius[3]: got -1, expected a number >= 0");
  CHECK(set.block(0).radius() == 1.0);
  CHECK(SLANT_COMPLAINT(power(slant::ball<2>{}, g)) == "radius[3]: got -1, expected a number >= 0");
  g[3] = std::numeric_limits<double>::quiet_NaN();
  CHECK(SLANT_COMPLAINT(power(slant::ball<2>{}, g)) ==
        "radius[3]: got nan, expected a number >= 0");
  vec<> const l = vec<>::Constant(3, 2.0);
  CHECK(SLANT_COMPLAINT(power(slant::interval<>{}, l, vec<>(-l)))
            .starts_with("l[0]: got 2, expected a number <= u"));
  CHECK(SLANT_COMPLAINT(power(slant::interval<>{}, l, g)) ==
        "length of parameter list 2: got 5, expected 3, the length of the list before it");
  CHECK(SLANT_COMPLAINT(set.update(l)) ==
        "number of parameters: got 3, expected 5, the number of blocks");
  CHECK(SLANT_COMPLAINT(power(slant::half_line<>{}, -1)) ==
        "number of blocks: got -1, expected a number >= 0");
}

TEST_CASE_TEMPLATE("contact_sets: the scalar is that of the data", S, float, oracle::float_50) {
  vec<S> const g = vec<S>::Constant(3, S(2));
  vec<S> const x = vec<S>::Constant(3, S(-9));
  CHECK(slant::project(slant::half_lines<S>(3), x) == vec<S>::Zero(3));
  CHECK(slant::project(slant::half_lines(g), x) == g);
  CHECK(slant::project(slant::intervals(g), x) == vec<S>(-g));
  CHECK(slant::project(slant::intervals(vec<S>(-g), g), x) == vec<S>(-g));
  CHECK(slant::project(slant::free_components<S>(3), x) == x);
  static_assert(std::is_same_v<typename decltype(slant::discs(g))::scalar, S>);
}

TEST_CASE("contact_sets: bad data is named") {
  vec<> const g = Vector2d(1, -2);
  CHECK(SLANT_COMPLAINT(slant::discs(g)) == "radius[1]: got -2, expected a number >= 0");
  CHECK(SLANT_COMPLAINT(slant::intervals(g)) == "radius[1]: got -2, expected a number >= 0");
  CHECK(SLANT_COMPLAINT(slant::intervals(g, vec<>(-g))) ==
        "l[0]: got 1, expected a number <= u = -1");
}

}  // namespace power_test
