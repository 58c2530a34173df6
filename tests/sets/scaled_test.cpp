// SPDX-License-Identifier: MIT
#include <slant/operators/product.hpp>  // the other `scaled`: the two must live side by side
#include <slant/sets/sets.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>
#include "counting_disc.hpp"
#include "oracle/precise.hpp"

namespace scaled_test {

using namespace products;
using slant::scaled;

TEST_CASE_TEMPLATE("scaled: a disc of c times the radius", S, float, double, oracle::float_50) {
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
  CHECK_THROWS_WITH_AS(static_cast<void>(scaled(0.0, slant::ball<2>{})),
                       "c: got 0, expected a finite number > 0", slant::bad_input);
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
auto plain() {
  return slant::cartesian(slant::half_lines(VectorXd{{0.5, -1.0}}), slant::discs(VectorXd{{2.0}}),
                          slant::free_components(1));
}
auto twin() {
  return slant::cartesian(slant::half_lines(VectorXd{{1.0, -3.0}}), slant::discs(VectorXd{{0.5}}),
                          slant::free_components(1));
}
VectorXd const d{{2.0, 3.0, 0.25, 0.25, 7.0}};

TEST_CASE("block_scaled: every block has its own factor") {
  auto const set = slant::block_scaled(d, plain());
  auto const other = twin();
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

TEST_CASE("block_scaled: the laws of sets") {
  auto const set = slant::block_scaled(d, plain());
  slant::testing::check_set_laws(set, VectorXd(5));
}

TEST_CASE("block_scaled: no allocation") {
  auto const set = slant::block_scaled(d, plain());
  VectorXd const x = VectorXd::Constant(5, -4.0);
  VectorXd y(5);
  CHECK(test::allocations_of([&] { slant::project(set, x, y); }) == 0);
}

TEST_CASE("block_scaled: factors are checked") {
  CHECK_THROWS_WITH(static_cast<void>(slant::block_scaled(VectorXd{{1.0}}, plain())),
                    "d: got 1, expected the dimension of the set, 5");
  CHECK_THROWS_WITH(
      static_cast<void>(slant::block_scaled(VectorXd{{1.0, 0.0, 1.0, 1.0, 1.0}}, plain())),
      "d(1): got 0, expected a finite number > 0");
  CHECK_THROWS_WITH(
      static_cast<void>(slant::block_scaled(VectorXd{{1.0, 1.0, 1.0, 2.0, 1.0}}, plain())),
      "d(3): got 2, expected 1 as for the other unknowns of its block");
}

}  // namespace scaled_test
