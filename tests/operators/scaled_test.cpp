// SPDX-License-Identifier: MIT
#include <slant/operators/operators.hpp>
#include <slant/testing/archetypes.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>
#include "operators/dense_oracle.hpp"

namespace scaled_test {

TEST_CASE("a multiple is the multiple of the matrix") {
  MatrixXd const m = test::random_dense(4, 4, 1);
  auto const a = slant::scaled(-1.5, m);
  CHECK(test::matches(a, MatrixXd(-1.5 * m)));
  static_assert(slant::has_accumulate<decltype(a), VectorXd>);
  static_assert(slant::has_adjoint_accumulate<decltype(a), VectorXd>);
  static_assert(slant::has_diagonal<decltype(a), VectorXd>);
  static_assert(slant::has_columns<decltype(a), MatrixXd>);
  slant::testing::check_operator_laws(a);
  CHECK(test::matches(slant::scaled(2, slant::identity(3)), MatrixXd(2 * MatrixXd::Identity(3, 3)),
                      0));
  CHECK(test::matches(slant::scaled(0.5, Eigen::MatrixXf(m.cast<float>())),
                      Eigen::MatrixXf(m.cast<float>() / 2)));
}

TEST_CASE("closure: a plain number and a positive one keep definiteness, any_sign does not") {
  using namespace slant;
  MatrixXd const m = test::random_spd(3, 2);
  auto const definite = matrix<self_adjoint, positive_definite>(m);
  auto const p = scaled(positive(2.0), definite);
  static_assert(spd_operator<decltype(p), VectorXd>);
  static_assert(std::is_same_v<decltype(scaled(2.0, definite)), std::remove_const_t<decltype(p)>>);
  testing::check_operator_laws(p);
  static_assert(laws_of<decltype(scaled(any_sign(2.0), definite))> == laws<law::self_adjoint>);
  testing::check_operator_laws(scaled(any_sign(-2.0), definite));
  CHECK(test::message<bad_input>([&] { (void)scaled(-2.0, definite); }) ==
        "c: got -2, expected a number > 0 in front of a definite operator; for others write "
        "-(c * A) or any_sign(c) * A");
  CHECK_THROWS_AS((void)scaled(0, definite), bad_input);
  CHECK_NOTHROW((void)scaled(0.0, matrix<self_adjoint, positive_semidefinite>(m)));
  // 2 I is no projector.
  static_assert(laws_of<decltype(scaled(positive(2), identity(3)))> ==
                laws<law::self_adjoint, law::positive_definite>);
  static_assert(laws_of<decltype(scaled(positive(2.0), matrix(m)))> == law_set{});
}

TEST_CASE("the inverse, where the part knows its own") {
  auto const p = slant::scaled(slant::positive(4), slant::diagonal<slant::positive_definite>(
                                                       VectorXd(VectorXd::LinSpaced(3, 1, 2))));
  static_assert(slant::has_inverse<decltype(p), VectorXd>);
  static_assert(slant::spd_operator<decltype(p.inverse()), VectorXd>);
  slant::testing::check_operator_laws(p);
}

TEST_CASE("the factor of an inverse is rounded in the scalar of the vector") {
  using S = long double;
  auto const p = slant::scaled(slant::positive(3), slant::identity(2));
  test::column<S> x(2);
  x << S(1), S(2);
  test::column<S> y(2);
  slant::apply(p.inverse(), x, y);
  CHECK(y[0] == S(1) / S(3));
  auto const z = y;
  auto const inverse = p.inverse();
  auto w = slant::workspace(inverse, x);
  slant::apply_add(inverse, S(-1), x, y, w);
  CHECK(y == test::column<S>::Zero(2));
  slant::apply(p.inverse().inverse(), x, y);
  CHECK(y == test::column<S>(3 * x));
  CHECK(z[1] == S(2) / S(3));
  CHECK(test::message<slant::bad_input>([] {
          (void)slant::scaled(slant::positive(1e-310), slant::identity(1)).inverse();
        }) == "c: got 1e-310, expected a number with a finite reciprocal");
}

TEST_CASE("the archetype has nothing more when scaled") {
  slant::testing::archetype::linear_operator const a(test::random_dense(4, 4, 3));
  auto const s = slant::scaled(3.0, a);
  slant::testing::archetype::vector const x(test::random_column(4, 4));
  static_assert(!slant::has_accumulate<decltype(s), slant::testing::archetype::vector>);
  static_assert(!slant::has_adjoint<decltype(s), slant::testing::archetype::vector>);
  slant::testing::check_operator_laws(s, x);
}

TEST_CASE("the factor must be a number, and positive if that is claimed") {
  using slant::bad_input;
  double const nan = std::numeric_limits<double>::quiet_NaN();
  double const infinity = std::numeric_limits<double>::infinity();
  CHECK(test::message<bad_input>([&] { (void)slant::scaled(nan, slant::identity(1)); }) ==
        "c: got nan, expected a finite number");
  CHECK(test::message<bad_input>([&] { (void)slant::scaled(infinity, slant::identity(1)); }) ==
        "c: got inf, expected a finite number");
  CHECK(test::message<bad_input>([] { (void)slant::positive_factor<double>{-1.0}; }) ==
        "c: got -1, expected a finite number > 0");
  static_assert(!std::is_aggregate_v<slant::positive_factor<double>>);
  static_assert(!std::is_default_constructible_v<slant::positive_factor<double>>);
  CHECK(test::message<bad_input>([] { (void)slant::positive(0.0); }) ==
        "c: got 0, expected a finite number > 0");
  CHECK(test::message<bad_input>([] { (void)slant::positive(-1); }) ==
        "c: got -1, expected a finite number > 0");
  CHECK(test::message<bad_input>([&] { (void)slant::positive(nan); }) ==
        "c: got nan, expected a finite number > 0");
  CHECK(test::message<bad_input>([&] { (void)slant::positive(infinity); }) ==
        "c: got inf, expected a finite number > 0");
}

}  // namespace scaled_test
