// SPDX-License-Identifier: MIT
#include <slant/operators/product.hpp>  // the other `scaled`: the two must live side by side
#include <slant/sets/sets.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>
#include "counting_disc.hpp"
#include "oracle/precise.hpp"

namespace images_test {

using namespace products;
using Vector1d = Eigen::Matrix<double, 1, 1>;
using Eigen::Matrix2d;
using slant::block_state;
using slant::scaled;
using slant::shifted;
using slant::detail::contains_within;
using slant::detail::state_within;

/// A client's block that can do the least.
struct plain {
  static constexpr int dimension = 2;
  Vector2d project(auto const& x) const { return x; }
  bool contains(auto const&) const { return true; }
};

TEST_CASE("image of a block: images of images") {
  auto const set = shifted(scaled(2.0, slant::ball<2>{3.0}), Vector2d(10, 0));
  CHECK(set.project(Vector2d(20, 0)) == Vector2d(16, 0));
  auto const other = scaled(2.0, shifted(slant::ball<2>{3.0}, Vector2d(5, 0)));
  CHECK(other.project(Vector2d(20, 0)) == Vector2d(16, 0));
  CHECK(set.part().part().radius() == 3.0);
  CHECK(set.with(1.0).project(Vector2d(20, 0)) == Vector2d(12, 0));
  CHECK(set.slant(Vector2d(20, 0)) == slant::ball<2>{6.0}.slant(Vector2d(10, 0)));
}

TEST_CASE("image of a block: the blocks of a product stay blocks if the map does not mix them") {
  auto const node = cartesian(slant::half_line<>{}, slant::ball<2>{});
  auto const moved = shifted(node, Vector3d(1, 2, 3));
  CHECK(moved.block_count() == 2);
  std::vector<VectorXd> centres;
  moved.visit([&](auto const& block, auto const& p) {
    CHECK(p.index() == slant::index(centres.size()));
    centres.emplace_back(block.map().centre());
  });
  REQUIRE(centres.size() == 2);
  CHECK(centres[0] == VectorXd::Constant(1, 1.0));
  CHECK(centres[1] == Vector2d(2, 3));
  auto const turned = rotated(node, Eigen::Matrix3d::Identity());
  CHECK(turned.block_count() == 1);
  static_assert(!slant::has_visit<decltype(turned)>);
}

TEST_CASE("image of a block: what rounding may have lost in one block excuses nothing in another") {
  auto const quadrant = cartesian(slant::half_line<>{}, slant::half_line<>{});
  auto const check = [](auto const& set) {
    CHECK(set.contains(Vector2d(1e-6, 2e10)));
    CHECK(!set.contains(Vector2d(-1e-6, 2e10)));
    // In the block whose shift is large, its rounding still counts.
    CHECK(set.contains(set.project(Vector2d(-1, -1))));
    CHECK(!set.contains(Vector2d(-1e-6, 1e10)));
  };
  check(shifted(quadrant, Vector2d(0, 1e10)));
  check(scaled(2.0, shifted(quadrant, Vector2d(0, 5e9))));
  check(shifted(scaled(2.0, quadrant), Vector2d(0, 1e10)));
  check(scaled(2.0, quadrant));
  check(cartesian(slant::half_line<>{}, shifted(slant::half_line<>{}, Vector1d(1e10))));

  auto const moved = shifted(quadrant, Vector2d(0, 1e10));
  double const ulp = 0x1p-19;  // of 1e10
  CHECK(moved.contains(Vector2d(0, 1e10 - ulp)));
  CHECK(!moved.contains(Vector2d(-ulp, 1e10 - ulp)));
  CHECK(!moved.contains(Vector2d(std::numeric_limits<double>::quiet_NaN(), 2e10)));
}

TEST_CASE("image of a block: has what its part has, no more") {
  using moved_space = decltype(shifted(slant::free_space<2>{}, Vector2d()));
  static_assert(slant::whole_space<moved_space>);
  using moved_point = decltype(shifted(slant::point<2>{}, Vector2d()));
  static_assert(!slant::has_inequality_form<moved_point, Vector2d>);
  static_assert(slant::has_support<moved_point, Vector2d>);
  using moved_plain = decltype(shifted(plain{}, Vector2d()));
  static_assert(slant::set_block<moved_plain>);
  static_assert(!slant::has_slant<moved_plain, Vector2d>);
  static_assert(!slant::has_state<moved_plain, Vector2d>);
  static_assert(!slant::has_step_to_boundary<moved_plain, Vector2d>);
  static_assert(!slant::has_support<moved_plain, Vector2d>);
  static_assert(!slant::has_inequality_form<moved_plain, Vector2d>);
  CHECK(shifted(slant::free_space<2>{}, Vector2d(1, 2)).project(Vector2d(3, 4)) == Vector2d(3, 4));
}

/// A client's set of run-time dimension that is no product: the vectors with mean value <= 1.
struct small_mean {
  slant::index n;
  slant::index size() const { return n; }
  void project(auto const& x, auto& y) const {
    double const excess = x.sum() / double(n) - 1;
    y = x;
    if (excess > 0) y.array() -= excess;
  }
  bool contains(auto const& x) const { return x.sum() <= double(n); }
};

TEST_CASE("image of a product: of a set that is no product") {
  vec<> const c = Vector3d(1e6, 2e6, 3e6);
  auto const set = shifted(small_mean{3}, c);
  vec<> const x = c + numbers(3, 1) + vec<>::Constant(3, 10.0);
  vec<> const p = slant::project(set, x);
  CHECK((p - c).mean() == doctest::Approx(1.0));
  CHECK(set.contains(p));  // although p − c has lost six digits
  CHECK(!set.contains(x));
  static_assert(!slant::has_visit<decltype(set)>);
  static_assert(!slant::has_slant<decltype(set), vec<>>);
}

TEST_CASE("image of a product: images of images, in place and without allocation") {
  vec<> const c = numbers(6, 2);
  auto const product = slant::discs(vec<>(vec<>::Ones(3)));
  auto const inner = shifted(product, c);
  auto const set = scaled(2.0, inner);
  auto const twin = shifted(slant::discs(vec<>(vec<>::Constant(3, 2.0))), vec<>(2 * c));
  vec<> const x = numbers(6, 3) * 3;
  vec<> y = x;
  slant::testing::allocation_guard const guard;
  set.project(y, y);
  bool const inside = set.contains(y);
  double const step = set.step_to_boundary(y, x, 0.5);
  auto const allocations = guard.count();
  CHECK(allocations == 0);
  CHECK(inside);
  CHECK(step >= 0);
  CHECK((y - slant::project(twin, x)).norm() <= 1e-14);
  CHECK(set.support(x) == doctest::Approx(twin.support(x)));
  CHECK(slant::face_of(set, y) == slant::face_of(twin, y));
  CHECK(set.block_count() == 3);
  CHECK(&set.part() == &inner);
}

TEST_CASE("image of a product: infinite bounds stay infinite") {
  auto const set = shifted(slant::half_lines(vec<>(Vector2d(-infinity, 0))), vec<>(Vector2d(5, 5)));
  vec<> const x = Vector2d(-1e300, -1);
  CHECK(slant::project(set, x) == Vector2d(-1e300, 5));
  CHECK(set.support(vec<>(Vector2d(-1, 0))) == infinity);
  CHECK(set.support(vec<>(Vector2d(0, -2))) == -10.0);
}

TEST_CASE("rounding_reach: membership within a distance") {
  slant::ball<2> const disc{1.0};
  CHECK(contains_within(disc, Vector2d(1.0005, 0), 1e-3));
  CHECK(!contains_within(disc, Vector2d(1.002, 0), 1e-3));
  CHECK(contains_within(disc, Vector2d(0.5, 0), 0.0));
  CHECK(!contains_within(disc, Vector2d(infinity, 0), infinity));
  CHECK(!contains_within(disc, Vector2d(std::numeric_limits<double>::quiet_NaN(), 0), 1.0));
}

TEST_CASE("rounding_reach: the most confined state within a distance") {
  slant::ball<2> const disc{1.0};
  CHECK(state_within(disc, Vector2d(0.9, 0), 0.0) == block_state::free);
  CHECK(state_within(disc, Vector2d(0.9, 0), 0.05) == block_state::free);
  CHECK(state_within(disc, Vector2d(0.9, 0), 0.2) == block_state::sliding);
  CHECK(state_within(disc, Vector2d(1.05, 0), 0.2) == block_state::sliding);
  using number = Eigen::Matrix<double, 1, 1>;
  slant::half_line<> const line{0.0};
  CHECK(state_within(line, number(1e-9), 1e-8) == block_state::fixed);
  CHECK(state_within(line, number(1e-7), 1e-8) == block_state::free);
  slant::second_order_cone<2> const cone{1.0};
  CHECK(state_within(cone, Vector2d(1e-9, 0), 1e-8) == block_state::fixed);
  CHECK(state_within(cone, Vector2d(1, 1 - 1e-9), 1e-8) == block_state::sliding);
}

Matrix2d turn(double angle) {
  Matrix2d q;
  q << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  return q;
}

TEST_CASE("rotated: an ellipse turned by 90 degrees is the ellipse with exchanged axes") {
  slant::ellipse<> const twin{1.0, 3.0};
  Matrix2d q;
  q << 0, -1, 1, 0;
  auto const set = rotated(slant::ellipse<>{3.0, 1.0}, q);
  for (int k = 1; k < 40; ++k) {
    Vector2d const x = 0.2 * k * turn(0.3 * k).col(0);
    CHECK((set.project(x) - twin.project(x)).norm() <= 1e-14);
    CHECK(set.contains(x) == twin.contains(x));
    CHECK((set.slant(x) - twin.slant(x)).norm() <= 1e-13);
    CHECK(set.support(x) == doctest::Approx(twin.support(x)));
    CHECK(set.inequality(x)(0) == doctest::Approx(twin.inequality(x)(0)));
    CHECK((set.inequality_gradient(x) - twin.inequality_gradient(x)).norm() <= 1e-13);
    Eigen::Matrix<double, 1, 1> const ν(2.0);
    CHECK((set.inequality_hessian(x, ν) - twin.inequality_hessian(x, ν)).norm() <= 1e-13);
    Vector2d const p = set.project(x);
    CHECK(set.state(p) == twin.state(twin.project(x)));
    CHECK(set.step_to_boundary(0.5 * p, x) == doctest::Approx(twin.step_to_boundary(0.5 * p, x)));
  }
}

TEST_CASE("rotated: a flat ellipse at any angle contains its projections") {
  slant::ellipse<> const flat{1.0, 1e-6};
  for (int k = 0; k < 60; ++k) {
    auto const set = rotated(flat, turn(0.11 * k));
    Vector2d const x = turn(0.37 * k) * Vector2d(2, 1);
    Vector2d const p = set.project(x);
    CHECK(set.contains(p));
    CHECK(set.state(p) == block_state::sliding);
    Matrix2d const g = set.slant(x);
    CHECK(g == g.transpose());
  }
}

TEST_CASE("rotated: a square on its corner") {
  auto const box = slant::cartesian(slant::interval<>{}, slant::interval<>{});
  auto const set = rotated(box, turn(std::acos(-1.0) / 4));
  double const corner = std::sqrt(2.0);
  CHECK((set.project(Vector2d(3, 0)) - Vector2d(corner, 0)).norm() <= 1e-15);
  CHECK((set.project(Vector2d(2, 2)) - Vector2d(corner / 2, corner / 2)).norm() <= 1e-15);
  CHECK(!set.contains(Vector2d(0.99, 0.99)));
  CHECK(set.contains(Vector2d(0.7, 0.7)));
  static_assert(!slant::has_visit<decltype(set)>);
}

TEST_CASE_TEMPLATE("rotated: other scalars, and powers", S, float, oracle::float_50) {
  Eigen::Matrix<S, 2, 2> q;
  q << S(3) / S(5), S(-4) / S(5), S(4) / S(5), S(3) / S(5);
  auto const set = slant::power(rotated(slant::ellipse<S>{S(2), S(1)}, q), 2);
  Eigen::Matrix<S, Eigen::Dynamic, 1> x(4);
  x << S(3) * q(0, 0), S(3) * q(1, 0), S(0), S(0);
  auto const p = slant::project(set, x);
  S const tolerance = S(16) * std::numeric_limits<S>::epsilon();
  CHECK((p.template head<2>() - S(2) * q.col(0)).norm() <= tolerance);
  CHECK(set.contains(p));
}

TEST_CASE("rotated: a matrix that is not orthogonal is refused") {
  CHECK(SLANT_COMPLAINT(rotated(slant::ball<2>{}, 2 * Matrix2d::Identity())) ==
        "Q: got max |QᵀQ − I| = 3, expected an orthogonal matrix");
  Matrix2d q = turn(1.0);
  q(0, 1) = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(static_cast<void>(rotated(slant::ball<2>{}, q)), slant::bad_input);
  CHECK_THROWS_AS(static_cast<void>(rotated(slant::ball<2>{}, (1 + 1e-12) * turn(1.0))),
                  slant::bad_input);
}

TEST_CASE("shifted: a disc around a centre") {
  auto const set = shifted(slant::ball<2>{2.0}, Vector2d(10, 20));
  static_assert(slant::set_block<std::remove_cvref_t<decltype(set)>>);
  CHECK((set.project(Vector2d(13, 24)) - Vector2d(11.2, 21.6)).norm() <= 1e-14);
  CHECK(set.project(Vector2d(11, 21)) == Vector2d(11, 21));
  CHECK(shifted(slant::ball<1>{2.0}, Vector1d(0.1)).project(Vector1d(1e-17))(0) == 1e-17);
  auto const product = slant::half_lines(1) * slant::free_components(1);
  Vector2d const inside(1, 1e-9);
  CHECK(slant::project(shifted(product, Vector2d(0, 1e8)), inside) == inside);
  CHECK(set.contains(Vector2d(12, 20)));
  CHECK(!set.contains(Vector2d(12.001, 20)));
  CHECK(set.state(Vector2d(10, 20)) == block_state::free);
  CHECK(set.state(Vector2d(10, 22)) == block_state::sliding);
  CHECK(set.step_to_boundary(Vector2d(10, 21), Vector2d(0, -1)) == 3.0);
  CHECK(set.support(Vector2d(3, -4)) == 30 - 80 + 10);
  CHECK(set.slant(Vector2d(10, 30)) == slant::ball<2>{2.0}.slant(Vector2d(0, 10)));
  CHECK(set.inequality(Vector2d(10, 23))(0) == 5.0);
  CHECK(set.inequality_gradient(Vector2d(10, 23)) == Vector2d(0, 6));
  CHECK(set.inequality_hessian(Vector2d(10, 23), Eigen::Matrix<double, 1, 1>(3.0)) ==
        6 * Eigen::Matrix2d::Identity());
  CHECK(set.with(3.0).contains(Vector2d(13, 20)));
}

TEST_CASE("shifted: far away the last digits of x and c count, not those of the radius") {
  // At 1e8 a unit in the last place is 1.5e-8: the disc of radius 1e-3 is known to 5 digits.
  Vector2d const c(1e8, -3e8);
  auto const set = shifted(slant::ball<2>{1e-3}, c);
  for (int k = 0; k < 64; ++k) {
    double const angle = 0.1 * k;
    Vector2d const x = c + 5e-3 * Vector2d(std::cos(angle), std::sin(angle));
    Vector2d const p = set.project(x);
    CHECK(set.contains(p));
    CHECK(set.state(p) == block_state::sliding);
  }
  CHECK(set.state(c) == block_state::free);
  CHECK(!set.contains(Vector2d(c + Vector2d(2e-3, 0))));
  auto const line = shifted(slant::half_line<>{1e-9}, Eigen::Matrix<double, 1, 1>(1.0));
  CHECK(line.state(line.project(Eigen::Matrix<double, 1, 1>(0.0))) == block_state::fixed);
}

TEST_CASE("shifted: points that are not finite are not members") {
  auto const set = shifted(slant::ball<2>{2.0}, Vector2d(1, 1));
  CHECK(!set.contains(Vector2d(infinity, 0)));
  CHECK(!set.contains(Vector2d(std::numeric_limits<double>::quiet_NaN(), 0)));
  auto const line = shifted(slant::half_line<>{}, Eigen::Matrix<double, 1, 1>(1.0));
  CHECK(line.contains(Eigen::Matrix<double, 1, 1>(infinity)));
}

TEST_CASE("shifted: a product by a vector, block by block, without allocation") {
  vec<> const g = numbers(4, 1).cwiseAbs();
  auto const product = slant::cartesian(slant::half_lines(2), slant::discs<slant::planar>(g));
  vec<> const c = numbers(10, 2);
  auto const set = shifted(product, c);
  vec<> const x = numbers(10, 3) * 2;
  vec<> const d = numbers(10, 4);
  vec<> y(10);
  slant::testing::allocation_guard const guard;
  set.project(x, y);
  bool const inside = set.contains(y);
  double const step = set.step_to_boundary(y, d);
  double const support = set.support(-d.cwiseAbs());
  auto const allocations = guard.count();
  CHECK(allocations == 0);
  CHECK(inside);
  CHECK(y == vec<>(slant::project(product, vec<>(x - c)) + c));
  CHECK(step == product.step_to_boundary(vec<>(y - c), d));
  CHECK(support == doctest::Approx(product.support(vec<>(-d.cwiseAbs())) - c.dot(d.cwiseAbs())));
  CHECK(!set.contains(vec<>(c.array() - 1)));
  auto const face = slant::face_of(set, y);
  auto const centred = slant::face_of(product, vec<>(slant::project(product, vec<>(x - c))));
  CHECK(face == centred);
}

TEST_CASE("shifted: long vectors and products are referenced, so updates show") {
  vec<> g = vec<>::Ones(2);
  auto discs = slant::discs(g);
  vec<> c = vec<>::Zero(4);
  auto const set = shifted(discs, c);
  c.setConstant(10.0);
  g.setConstant(3.0);
  discs.update(g);
  vec<> const x = Eigen::Vector4d(10, 20, 20, 10);
  CHECK(slant::project(set, x) == Eigen::Vector4d(10, 13, 13, 10));
  auto const owner = shifted(slant::discs(g), vec<>(vec<>::Constant(4, 10.0)));
  CHECK(slant::project(owner, x) == Eigen::Vector4d(10, 13, 13, 10));
  auto const of_expression = shifted(slant::discs(g), c / 2);
  CHECK(slant::project(of_expression, vec<>(c * 2))[0] == doctest::Approx(5 + 3 / std::sqrt(2.0)));
}

TEST_CASE("shifted: powers of shifted blocks keep the centre") {
  vec<> const g = Vector2d(1, 2);
  auto const set = slant::power(shifted(slant::ball<2>{}, Vector2d(5, 5)), g);
  vec<> const x = Eigen::Vector4d(5, 9, 5, 9);
  CHECK(slant::project(set, x) == Eigen::Vector4d(5, 6, 5, 7));
}

TEST_CASE("shifted: bad centres are named") {
  vec<> c = vec<>::Zero(3);
  CHECK(SLANT_COMPLAINT(shifted(slant::half_lines(2), c)) ==
        "size of the shift: got 3, expected the dimension of the set, 2");
  c[1] = std::numeric_limits<double>::infinity();
  CHECK(SLANT_COMPLAINT(shifted(slant::half_lines(3), c)) ==
        "c[1]: got inf, expected a finite number");
}

TEST_CASE_TEMPLATE("scaled: a disc of c times the radius", S, float, oracle::float_50) {
  using vector = Eigen::Matrix<S, 2, 1>;
  auto const set = scaled(S(3), slant::ball<2, S>{S(2)});
  slant::ball<2, S> const twin{S(6)};
  S const tolerance = S(32) * std::numeric_limits<S>::epsilon();
  for (auto const& x : {vector(S(9), S(12)), vector(S(1), S(2)), vector(S(-70), S(1) / S(70))}) {
    CHECK((set.project(x) - twin.project(x)).norm() <= tolerance);
    CHECK(set.contains(x) == twin.contains(x));
    CHECK((set.slant(x) - twin.slant(x)).norm() <= tolerance);
    CHECK(S(set.support(x) - twin.support(x)) <= tolerance * x.norm());
    CHECK(S(set.support(x) - twin.support(x)) >= -tolerance * x.norm());
    CHECK(set.contains(set.project(x)));
    CHECK(set.state(set.project(x)) == twin.state(twin.project(x)));
  }
  S const step = set.step_to_boundary(vector(S(1), S(0)), vector(S(2), S(0)));
  CHECK(S(step - S(5) / S(2)) <= tolerance);
  CHECK(S(step - S(5) / S(2)) >= -tolerance);
}

TEST_CASE("scaled: f(x/c) and its derivatives") {
  auto const set = scaled(4.0, slant::ball<2>{0.5});
  Vector2d const x(1, 3);
  CHECK(set.inequality(x)(0) == (1.0 + 9.0) / 16 - 0.25);
  CHECK(set.inequality_gradient(x) == Vector2d(2.0 / 16, 6.0 / 16));
  CHECK(set.inequality_hessian(x, Eigen::Matrix<double, 1, 1>(3.0)) ==
        6.0 / 16 * Eigen::Matrix2d::Identity());
}

TEST_CASE("scaled: operators and sets") {
  VectorXd const x = Vector2d(1, 2);
  auto const operator_a = scaled(3.0, MatrixXd(Eigen::Matrix2d::Identity()));
  VectorXd y(2);
  slant::apply(operator_a, x, y);
  CHECK(y == 3 * x);
  CHECK(scaled(3, slant::half_line<>{2.0}).project(Eigen::Matrix<double, 1, 1>(0.0))(0) == 6.0);
}

TEST_CASE("scaled: bad factors are named") {
  CHECK(SLANT_COMPLAINT(scaled(0.0, slant::ball<2>{})) == "c: got 0, expected a finite number > 0");
  CHECK_THROWS_AS(static_cast<void>(scaled(-2.0, slant::ball<2>{})), slant::bad_input);
  CHECK_THROWS_AS(
      static_cast<void>(scaled(std::numeric_limits<double>::infinity(), slant::ball<2>{})),
      slant::bad_input);
  CHECK_THROWS_AS(
      static_cast<void>(scaled(std::numeric_limits<double>::quiet_NaN(), slant::half_lines(3))),
      slant::bad_input);
}

/// Two half lines, a disc at the components 2 and 3, a free unknown; and each blown up by d by
/// hand.
auto small_parts() {
  return slant::cartesian(slant::half_lines(VectorXd{{0.5, -1.0}}), slant::discs(VectorXd{{2.0}}),
                          slant::free_components(1));
}
auto blown_up() {
  return slant::cartesian(slant::half_lines(VectorXd{{1.0, -3.0}}), slant::discs(VectorXd{{0.5}}),
                          slant::free_components(1));
}
VectorXd const d{{2.0, 3.0, 0.25, 0.25, 7.0}};

TEST_CASE("block_scaled: every block has its own factor") {
  auto const set = slant::block_scaled(d, small_parts());
  auto const other = blown_up();
  CHECK(slant::dimension_of(set) == 5);
  CHECK(slant::block_count(set) == slant::block_count(other));
  for (unsigned seed = 1; seed <= 50; ++seed) {
    std::srand(seed);
    VectorXd const x = 3 * VectorXd::Random(5);
    VectorXd y(5), expected(5);
    slant::project(set, x, y);
    slant::project(other, x, expected);
    CHECK((y - expected).cwiseAbs().maxCoeff() <= 1e-15);
    CHECK(set.contains(y));
    CHECK(set.contains(x) == other.contains(x));
    VectorXd const v = VectorXd::Random(5);
    CHECK(set.step_to_boundary(y, v) == doctest::Approx(other.step_to_boundary(y, v)));
  }
}

TEST_CASE("block_scaled: the laws of sets; no allocation") {
  auto const set = slant::block_scaled(d, small_parts());
  slant::testing::check_set_laws(set, VectorXd(5));
  VectorXd const x = VectorXd::Constant(5, -4.0);
  VectorXd y(5);
  CHECK(test::allocations_of([&] { slant::project(set, x, y); }) == 0);
}

TEST_CASE("block_scaled: factors are checked") {
  CHECK_THROWS_WITH(static_cast<void>(slant::block_scaled(VectorXd{{1.0}}, small_parts())),
                    "d: got 1, expected the dimension of the set, 5");
  CHECK_THROWS_WITH(
      static_cast<void>(slant::block_scaled(VectorXd{{1.0, 0.0, 1.0, 1.0, 1.0}}, small_parts())),
      "d(1): got 0, expected a finite number > 0");
  CHECK_THROWS_WITH(
      static_cast<void>(slant::block_scaled(VectorXd{{1.0, 1.0, 1.0, 2.0, 1.0}}, small_parts())),
      "d(3): got 2, expected 1 as for the other unknowns of its block");
}

}  // namespace images_test
