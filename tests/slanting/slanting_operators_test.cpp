// SPDX-License-Identifier: MIT
//
// F°(y) of a composition has the capabilities of the operator composition it stands for.
#include <slant/sets/sets.hpp>
#include <slant/slanting/slanting.hpp>
#include <slant/testing/archetypes.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>
#include "slanting_support.hpp"

namespace slanting_operators_test {

using slanting_support::dense;

MatrixXd const m = slanting_support::random_matrix(4, 4, 1);
VectorXd const y{{1.0, -2.0, 0.0, 3.0}};

TEST_CASE("a linear function passes on all that its operator can") {
  auto const f = slant::linear(m);
  auto const g = f.slant(y);
  using slope = std::remove_cvref_t<decltype(g)>;
  static_assert(slant::has_adjoint<slope, VectorXd> && slant::has_accumulate<slope, VectorXd>);
  static_assert(slant::has_diagonal<slope, VectorXd> && slant::has_columns<slope, MatrixXd>);
  slant::testing::check_operator_laws(g);
  MatrixXd const many = slanting_support::random_matrix(4, 3, 5);
  MatrixXd result(4, 3);
  slant::apply(g, many, result);
  CHECK((result - m * many).norm() <= 1e-14);
}

TEST_CASE("compositions pass on what all parts can") {
  slant::identity_map const id(4);
  auto const p = slant::positive_part(4);
  auto const f = id - p * (2.0 * slant::linear(m) + id);
  auto const g = f.slant(y);
  using slope = std::remove_cvref_t<decltype(g)>;
  static_assert(slant::has_adjoint<slope, VectorXd> && slant::has_accumulate<slope, VectorXd>);
  slant::testing::check_operator_laws(g);
  auto const h = slant::max(f, slant::linear(m));
  slant::testing::check_operator_laws(h.slant(y));
}

TEST_CASE("declared laws hold") {
  MatrixXd const spd = slanting_support::random_spd(4, 3);
  auto const a = slant::matrix<slant::self_adjoint, slant::positive_definite>(spd);
  auto const f = slant::scale(slant::positive(0.5), slant::linear(a) + slant::positive_part(4));
  auto const g = f.slant(y);
  static_assert(slant::declares_positive_definite<std::remove_cvref_t<decltype(g)>>);
  slant::testing::check_operator_laws(g);
  slant::testing::check_operator_laws(slant::positive_part(4).slant(y));
  auto const set = slant::power(slant::ball<2>{}, VectorXd{{1.0, 5.0}});
  auto const residual = slant::natural_residual(a, y, set, 0.1);
  VectorXd const outside = 10 * y;
  slant::testing::check_operator_laws(slant::projection(set).slant(outside));
  slant::testing::check_operator_laws(slant::symmetrized(residual.slant(outside)));
}

TEST_CASE("no capability is invented") {
  namespace archetype = slant::testing::archetype;
  auto const f = slant::identity_map(4) + slant::linear(archetype::linear_operator(m));
  using slope = slant::slant_operator_t<std::remove_cvref_t<decltype(f)>, archetype::vector>;
  static_assert(slant::linear_operator<slope, archetype::vector>);
  static_assert(!slant::has_adjoint<slope, archetype::vector>);
  static_assert(!slant::has_accumulate<slope, archetype::vector>);
  static_assert(!slant::has_diagonal<slope, archetype::vector>);
  static_assert(!slant::linear_operator<slope, VectorXd>);
  auto const with_adjoint = slant::linear(archetype::operator_with_adjoint(m));
  using adjointable =
      slant::slant_operator_t<std::remove_cvref_t<decltype(with_adjoint)>, archetype::vector>;
  static_assert(slant::has_adjoint<adjointable, archetype::vector>);
}

TEST_CASE("copies of F°(y) are independent, except for the operators of F itself") {
  auto const f = slant::positive_part(4) * slant::linear(m);
  auto g = f.slant(y);
  auto const copy = g;
  MatrixXd const before = dense(copy, y);
  auto w = slant::workspace(f, y);
  slant::update_slant(f, VectorXd(-y), g, w);
  CHECK(dense(copy, y) == before);
  CHECK(dense(g, y) != before);
}

}  // namespace slanting_operators_test
