// SPDX-License-Identifier: MIT
#include <slant/factorizations/ldlt.hpp>
#include <slant/operators/operators.hpp>
#include <slant/testing/archetypes.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>
#include "operators/dense_oracle.hpp"

namespace inverse_test {

namespace archetype = slant::testing::archetype;

TEST_CASE("the inverse of a factorisation") {
  MatrixXd const m = test::random_spd(6, 1);
  auto const a = slant::inverse(slant::ldlt(m.sparseView()));
  CHECK(test::matches(a, MatrixXd(m.inverse()), 1000));
  static_assert(slant::spd_operator<decltype(a), VectorXd>);
  static_assert(slant::has_columns<decltype(a), MatrixXd>);
  static_assert(!slant::has_accumulate<decltype(a), VectorXd>);
  slant::testing::check_operator_laws(a, {.roundings = 1000});
}

TEST_CASE("a factorisation passed as an lvalue is referenced") {
  slant::ldlt const factors(MatrixXd(test::random_spd(4, 2)).sparseView());
  auto const a = slant::inverse(factors);
  CHECK(&a.factors() == &factors);
}

TEST_CASE("archetypes: a solve is enough, and promises nothing") {
  MatrixXd const m = test::random_spd(4, 3);
  archetype::factorization const plain(m);
  auto const a = slant::inverse(plain);
  archetype::vector const x(test::random_column(4, 4));
  static_assert(slant::laws_of<decltype(a)> == slant::law_set{});
  static_assert(!slant::has_adjoint<decltype(a), archetype::vector>);
  static_assert(!slant::linear_operator<decltype(a), VectorXd>);
  static_assert(!slant::has_columns<decltype(a), MatrixXd>);
  slant::testing::check_operator_laws(a, x, {.roundings = 1000});
  auto const b = slant::inverse(archetype::spd_factorization(m));
  static_assert(slant::spd_operator<decltype(b), archetype::vector>);
  slant::testing::check_operator_laws(b, x, {.roundings = 1000});
}

/// A factorisation that tells its columns, too.
struct half {
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::positive_definite>;
  [[nodiscard]] Eigen::Index rows() const { return 2; }
  [[nodiscard]] Eigen::Index cols() const { return 2; }
  void solve(VectorXd const& b, VectorXd& x) const { x = b / 2; }
};

TEST_CASE("a factorisation may have cols") {
  static_assert(slant::factorization<half, VectorXd>);
  auto const a = slant::inverse(half{});
  static_assert(slant::spd_operator<decltype(a), VectorXd>);
  VectorXd y(2);
  slant::apply(a, VectorXd(Vector2d(2, 4)), y);
  CHECK(y == Vector2d(1, 2));
  auto const s =
      slant::schur_complement(half{}, slant::identity_operator(2), slant::identity_operator(2));
  slant::apply(s, VectorXd(Vector2d(2, 4)), y);
  CHECK(y == Vector2d(3, 6));
}

/// A nonsymmetric factorisation that can also solve with the transposed matrix.
struct lu {
  Eigen::PartialPivLU<MatrixXd> factors;
  [[nodiscard]] slant::index rows() const { return factors.rows(); }
  void solve(VectorXd const& b, VectorXd& x) const { x = factors.solve(b); }
  void solve_adjoint(VectorXd const& b, VectorXd& x) const { x = factors.transpose().solve(b); }
};

TEST_CASE("solve_adjoint makes an adjoint") {
  MatrixXd const m = test::random_dense(5, 5, 5) + 3 * MatrixXd::Identity(5, 5);
  auto const a = slant::inverse(lu{m.partialPivLu()});
  static_assert(slant::has_adjoint<decltype(a), VectorXd>);
  static_assert(!slant::is_self_adjoint<decltype(a)>);
  CHECK(test::matches(a, MatrixXd(m.inverse()), 1000));
  slant::testing::check_operator_laws(a, {.roundings = 1000});
}

}  // namespace inverse_test
