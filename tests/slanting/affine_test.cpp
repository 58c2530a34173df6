// SPDX-License-Identifier: MIT
#include <slant/operators/diagonal.hpp>
#include <slant/slanting/affine.hpp>
#include <slant/slanting/smooth.hpp>
#include <slant/testing/archetypes.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>
#include "slanting_support.hpp"

namespace affine_test {

using slanting_support::dense_slant;
using slanting_support::random_matrix;
using slanting_support::random_vector;

TEST_CASE("y -> A y + c and y -> A y") {
  MatrixXd const a = random_matrix(3, 4, 1);
  VectorXd const c = random_vector(3, 2);
  VectorXd const y = random_vector(4, 3);
  auto const f = slant::affine(a, c);
  CHECK((slant::evaluate(f, y) - (a * y + c)).norm() <= 1e-15);
  CHECK(dense_slant(f, y) == a);
  auto const g = slant::linear(a);
  CHECK((slant::evaluate(g, y) - a * y).norm() <= 1e-15);
  CHECK(dense_slant(g, y) == a);
  CHECK(f.rows() == 3);
  CHECK(f.cols() == 4);
  slant::testing::check_slanting_laws(f, y);
}

TEST_CASE("lvalues are referenced, rvalues and expressions owned") {
  MatrixXd a = MatrixXd::Identity(2, 2);
  VectorXd c = VectorXd::Zero(2);
  VectorXd const y{{1.0, 2.0}};
  auto const f = slant::affine(a, c);
  auto const with_expression = slant::affine(a, -c);
  a(0, 0) = 5;
  c[1] = 7;
  CHECK(slant::evaluate(f, y) == VectorXd{{5.0, 9.0}});
  CHECK(slant::evaluate(with_expression, y) == VectorXd{{5.0, 2.0}});
  auto const owner = [] {
    return slant::affine(MatrixXd(2 * MatrixXd::Identity(2, 2)), VectorXd::Ones(2));
  }();
  CHECK(slant::evaluate(owner, y) == VectorXd{{3.0, 5.0}});
}

TEST_CASE("archetype operator and vector") {
  namespace archetype = slant::testing::archetype;
  archetype::linear_operator const a(random_matrix(3, 3, 4));
  auto const f = slant::affine(a, archetype::vector(random_vector(3, 5)));
  slant::testing::check_slanting_laws(f, archetype::vector(random_vector(3, 6)));
}

TEST_CASE("bad input") {
  MatrixXd const a = MatrixXd::Identity(3, 3);
  CHECK(SLANT_COMPLAINT(slant::affine(a, VectorXd::Ones(2))) ==
        "c.size(): got 2, expected 3 (the number of values)");
  VectorXd c = VectorXd::Ones(3);
  c[1] = std::numeric_limits<double>::infinity();
  CHECK(SLANT_COMPLAINT(slant::affine(a, c)) == "c[1]: got inf, expected a finite number");
}

TEST_CASE("the identity") {
  slant::identity_map const f(3);
  VectorXd const y{{1.0, -2.0, 3.0}};
  CHECK(slant::evaluate(f, y) == y);
  CHECK(dense_slant(f, y).isIdentity(0));
  static_assert(
      slant::declares_positive_definite<slant::slant_operator_t<slant::identity_map, VectorXd>>);
  static_assert(slant::has_slant_update<slant::identity_map, VectorXd>);
  slant::testing::check_slanting_laws(f, y, slant::testing::archetype::vector(y));
  CHECK_THROWS_WITH_AS(slant::identity_map(-1), "n: got -1, expected a size >= 0",
                       slant::bad_input);
}

auto circle_and_line() {
  return slant::smooth(
      2, 2,
      [](auto const& y, auto& f) {
        f[0] = y[0] * y[0] + y[1] * y[1] - 25;
        f[1] = y[0] - 2 * y[1] + 5;
      },
      [](auto const& y) {
        return Eigen::Matrix2d{{2 * y[0], 2 * y[1]}, {1, -2}};
      });
}

/// x ↦ D x, D renewed in place.
struct slope_operator {
  VectorXd d;
  [[nodiscard]] slant::index rows() const { return d.size(); }
  [[nodiscard]] slant::index cols() const { return d.size(); }
  void apply(VectorXd const& x, VectorXd& y) const { y = d.cwiseProduct(x); }
};

TEST_CASE("a derivative given as a matrix; Newton's method finds the intersection (3, 4)") {
  auto const f = circle_and_line();
  Vector2d y(5, 5);
  for (int k = 0; k < 6; ++k) {
    y -= slanting_support::solve(slanting_support::dense_slant(f, y),
                                 VectorXd(slant::evaluate(f, y)));
  }
  CHECK((y - Vector2d(3, 4)).norm() <= 1e-14);
  slant::testing::check_slanting_laws(f, y, Vector2d(0, 0), VectorXd(Vector2d(1, -2)));
}

TEST_CASE("a renewed derivative does not allocate") {
  auto const f = slant::smooth(
      3, 3, [](VectorXd const& y, VectorXd& v) { v = y.array().sin(); },
      [](VectorXd const& y) { return slope_operator{y.array().cos()}; },
      [](VectorXd const& y, slope_operator& g) { g.d = y.array().cos(); });
  VectorXd const y{{0.1, 1.0, -2.0}};
  slant::testing::check_slanting_laws(f, y);
  static_assert(slant::has_slant_update<std::remove_cvref_t<decltype(f)>, VectorXd>);
  auto g = f.slant(VectorXd::Zero(3).eval());
  auto w = slant::workspace(f, y);
  CHECK(test::allocations_of([&] { slant::update_slant(f, y, g, w); }) == 0);
  CHECK(g.d == VectorXd(y.array().cos()));
}

TEST_CASE("asserted laws belong to the derivative") {
  auto const f = slant::smooth<slant::self_adjoint, slant::positive_definite>(
      2, 2, [](auto const& y, auto& v) { v = y.array().exp(); },
      [](auto const& y) { return Eigen::Matrix2d(y.array().exp().matrix().asDiagonal()); });
  using slope = slant::slant_operator_t<std::remove_cvref_t<decltype(f)>, Vector2d>;
  static_assert(slant::spd_operator<slope, Vector2d>);
  slant::testing::check_slanting_laws(f, Vector2d(0.5, -1));
}

TEST_CASE("a derivative full of NaN is the method's to report") {
  auto const f = circle_and_line();
  CHECK(std::isnan(slanting_support::dense_slant(f, Vector2d(quiet_nan, 1))(0, 0)));
}

TEST_CASE("bad input of smooth maps") {
  auto const value = [](auto const&, auto&) {};
  auto const derivative = [](auto const&) { return Eigen::Matrix2d(); };
  CHECK(SLANT_COMPLAINT(slant::smooth(-1, 2, value, derivative)) ==
        "rows, cols: got -1, 2, expected sizes >= 0");
}

}  // namespace affine_test
