// SPDX-License-Identifier: MIT
#include <slant/operators/operators.hpp>
#include <slant/testing/archetypes.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>
#include "operators/dense_oracle.hpp"

namespace product_test {

using namespace test::evaluated;
namespace archetype = slant::testing::archetype;

TEST_CASE("a product is the product of the matrices") {
  auto const s = test::random_sparse(4, 6, 1);
  MatrixXd const m = test::random_dense(6, 5, 2);
  auto const a = slant::product(s, m);
  CHECK(test::matches(a, MatrixXd(s * m)));
  static_assert(slant::has_accumulate<decltype(a), VectorXd>);
  static_assert(slant::has_adjoint_accumulate<decltype(a), VectorXd>);
  static_assert(slant::has_columns<decltype(a), MatrixXd>);
  static_assert(!slant::has_diagonal<decltype(a), VectorXd>);
  slant::testing::check_operator_laws(a);

  MatrixXd const n = test::random_dense(5, 3, 3);
  CHECK(test::matches(slant::product(s, m, n), MatrixXd(s * m * n)));
}

TEST_CASE("closure: no law survives") {
  using namespace slant;
  MatrixXd const m = test::random_spd(3, 4);
  auto const definite = matrix<self_adjoint, positive_definite>(m);
  static_assert(laws_of<decltype(product(definite, definite))> == law_set{});
}

/// A matrix that knows its inverse. (Those of the library are diagonal and commute.)
struct regular {
  MatrixXd m;
  [[nodiscard]] slant::index rows() const { return m.rows(); }
  [[nodiscard]] slant::index cols() const { return m.cols(); }
  void apply(VectorXd const& x, VectorXd& y) const { y.noalias() = m * x; }
  [[nodiscard]] regular inverse() const { return {m.inverse()}; }
};

TEST_CASE("the inverse of a product is the product of the inverses, reversed") {
  regular const a{test::random_spd(4, 7)}, b{test::random_spd(4, 8)};
  auto const p = slant::product(a, b);
  static_assert(slant::has_inverse<decltype(p), VectorXd>);
  slant::testing::check_operator_laws(p);
}

TEST_CASE("archetypes") {
  MatrixXd const m = test::random_dense(4, 4, 5);
  archetype::linear_operator const a(m);
  archetype::operator_with_adjoint const b(m);
  archetype::vector const x(test::random_column(4, 6));
  auto const p = slant::product(a, b);
  static_assert(!slant::linear_operator<decltype(p), VectorXd>);
  static_assert(!slant::has_accumulate<decltype(p), archetype::vector>);
  static_assert(!slant::has_adjoint<decltype(p), archetype::vector>);
  slant::testing::check_operator_laws(p, x);
  auto const q = slant::product(b, b);
  static_assert(slant::has_adjoint<decltype(q), archetype::vector>);
  slant::testing::check_operator_laws(q, x);
  auto const s = slant::scaled(3.0, a);
  static_assert(!slant::has_accumulate<decltype(s), archetype::vector>);
  static_assert(!slant::has_adjoint<decltype(s), archetype::vector>);
  slant::testing::check_operator_laws(s, x);
  // apply_add needs only that of the outer part
  auto const r = slant::product(slant::slice(4, 0, 4), a);
  static_assert(slant::has_accumulate<decltype(r), archetype::vector>);
  slant::testing::check_operator_laws(r, x);
}

TEST_CASE("sizes must fit") {
  CHECK(SLANT_COMPLAINT(slant::product(MatrixXd(MatrixXd::Ones(3, 2)), slant::identity(3))) ==
        "B: got 3 x 3, expected 2 rows (the columns of A)");
}

TEST_CASE("a multiple is the multiple of the matrix") {
  MatrixXd const m = test::random_dense(4, 4, 1);
  auto const a = slant::scaled(-1.5, m);
  CHECK(test::matches(a, MatrixXd(-1.5 * m)));
  static_assert(slant::has_accumulate<decltype(a), VectorXd>);
  static_assert(slant::has_adjoint_accumulate<decltype(a), VectorXd>);
  static_assert(slant::has_diagonal<decltype(a), VectorXd>);
  static_assert(slant::has_columns<decltype(a), MatrixXd>);
  slant::testing::check_operator_laws(a);
}

TEST_CASE("the factor of an inverse is rounded in the scalar of the vector") {
  using S = long double;
  auto const p = slant::scaled(slant::positive(3), slant::identity(2));
  test::column<S> x(2);
  x << S(1), S(2);
  test::column<S> y(2);
  slant::apply(p.inverse(), x, y);
  CHECK(y[0] == S(1) / S(3));
  CHECK(y[1] == S(2) / S(3));
  auto const inverse = p.inverse();
  auto w = slant::workspace(inverse, x);
  slant::apply_add(inverse, S(-1), x, y, w);
  CHECK(y == test::column<S>::Zero(2));
  slant::apply(p.inverse().inverse(), x, y);
  CHECK(y == test::column<S>(3 * x));
  CHECK(SLANT_COMPLAINT(slant::scaled(slant::positive(1e-310), slant::identity(1)).inverse()) ==
        "c: got 1e-310, expected a number with a finite reciprocal");
}

TEST_CASE("the factor must be a number, and positive if that is claimed") {
  CHECK(SLANT_COMPLAINT(slant::scaled(infinity, slant::identity(1))) ==
        "c: got inf, expected a finite number");
  static_assert(!std::is_aggregate_v<slant::positive_factor<double>>);
  static_assert(!std::is_default_constructible_v<slant::positive_factor<double>>);
  CHECK(SLANT_COMPLAINT(slant::positive_factor<double>{-1.0}) ==
        "c: got -1, expected a finite number > 0");
  auto const positive = [](auto c) { return test::complaint([c] { (void)slant::positive(c); }); };
  CHECK(positive(0.0) == "c: got 0, expected a finite number > 0");
  CHECK(positive(-1) == "c: got -1, expected a finite number > 0");
  CHECK(positive(quiet_nan) == "c: got nan, expected a finite number > 0");
  CHECK(positive(infinity) == "c: got inf, expected a finite number > 0");
}

}  // namespace product_test
