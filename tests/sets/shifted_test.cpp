// SPDX-License-Identifier: MIT
#include <slant/sets/sets.hpp>

#include <support/testing.hpp>
#include "counting_disc.hpp"

namespace shifted_test {

using namespace products;
using slant::block_state;
using slant::shifted;

TEST_CASE("shifted: a disc around a centre") {
  auto const set = shifted(slant::ball<2>{2.0}, Vector2d(10, 20));
  static_assert(slant::set_block<std::remove_cvref_t<decltype(set)>>);
  CHECK((set.project(Vector2d(13, 24)) - Vector2d(11.2, 21.6)).norm() <= 1e-14);
  CHECK(set.project(Vector2d(11, 21)) == Vector2d(11, 21));
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
  double const infinity = std::numeric_limits<double>::infinity();
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
  CHECK(test::complaint([&] { static_cast<void>(shifted(slant::half_lines(2), c)); }) ==
        "size of the shift: got 3, expected the dimension of the set, 2");
  c[1] = std::numeric_limits<double>::infinity();
  CHECK(test::complaint([&] { static_cast<void>(shifted(slant::half_lines(3), c)); }) ==
        "c[1]: got inf, expected a finite number");
}

}  // namespace shifted_test
