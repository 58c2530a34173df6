// SPDX-License-Identifier: MIT
#include <slant/operators/counted.hpp>
#include <slant/slanting/slanting.hpp>
#include <slant/testing/archetypes.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>
#include "slanting_support.hpp"

namespace stack_test {

using slanting_support::dense_slant;
using slanting_support::random_matrix;
using slanting_support::random_vector;

TEST_CASE("functions of the same argument, one above the other") {
  MatrixXd const a = random_matrix(2, 3, 1);
  auto const f = slant::stack(slant::linear(a), slant::positive_part(3), -slant::positive_part(3));
  CHECK(f.rows() == 8);
  CHECK(f.cols() == 3);
  VectorXd const y{{1.0, -2.0, 0.0}};
  VectorXd expected(8);
  expected << a * y, 1, 0, 0, -1, 0, 0;
  CHECK((slant::evaluate(f, y) - expected).norm() <= 1e-15);
  MatrixXd slope = MatrixXd::Zero(8, 3);
  slope.topRows(2) = a;
  slope(2, 0) = slope(4, 2) = 1;
  slope(5, 0) = slope(7, 2) = -1;
  CHECK(dense_slant(f, y) == slope);
  slant::testing::check_slanting_laws(f, y, random_vector(3, 2));
  auto const g = f.slant(y);
  static_assert(slant::has_adjoint<decltype(g), VectorXd>);
  slant::testing::check_operator_laws(g);
}

TEST_CASE("a slant after a value evaluates nothing again; nothing allocates") {
  MatrixXd const m = random_matrix(4, 4, 1);
  auto const a = slant::counted(m);
  auto const inner = slant::positive_part(slant::affine(a, random_vector(4, 2)));
  auto const f = slant::stack(slant::positive_part(4), slant::positive_part(4) * inner);
  slanting_support::check_products(f, a, random_vector(4, 3));
  slanting_support::check_renewal(f, random_vector(4, 3));
}

TEST_CASE("archetypes") {
  namespace archetype = slant::testing::archetype;
  archetype::slanting_function const f(2);
  auto const g = slant::stack(f, f);
  VectorXd const y{{1.0, -2.0}};
  CHECK(slant::evaluate(g, archetype::vector(y)).local() == VectorXd{{1.5, 1.0, 1.5, 1.0}});
  slant::testing::check_slanting_laws(g, archetype::vector(y));
  CHECK(&g.part<1>() == &f);
}

TEST_CASE("bad input") {
  CHECK_THROWS_WITH_AS(
      static_cast<void>(slant::stack(slant::positive_part(3), slant::positive_part(2))),
      "f2.cols(): got 2, expected 3 (f1.cols())", slant::bad_input);
}

}  // namespace stack_test
