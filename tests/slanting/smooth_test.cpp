// SPDX-License-Identifier: MIT
#include <slant/operators/diagonal.hpp>
#include <slant/slanting/smooth.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>
#include "slanting_support.hpp"

namespace smooth_test {

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
  double const nan = std::nan("");
  CHECK(std::isnan(slanting_support::dense_slant(f, Vector2d(nan, 1))(0, 0)));
}

TEST_CASE("bad input") {
  auto const value = [](auto const&, auto&) {};
  auto const derivative = [](auto const&) { return Eigen::Matrix2d(); };
  CHECK_THROWS_WITH_AS(static_cast<void>(slant::smooth(-1, 2, value, derivative)),
                       "rows, cols: got -1, 2, expected sizes >= 0", slant::bad_input);
}

}  // namespace smooth_test
