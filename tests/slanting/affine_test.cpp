// SPDX-License-Identifier: MIT
#include <slant/slanting/affine.hpp>
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
  CHECK_THROWS_WITH_AS(static_cast<void>(slant::affine(a, VectorXd::Ones(2))),
                       "c.size(): got 2, expected 3 (the number of rows of the operator)",
                       slant::bad_input);
  VectorXd c = VectorXd::Ones(3);
  c[1] = std::numeric_limits<double>::infinity();
  CHECK_THROWS_WITH_AS(static_cast<void>(slant::affine(a, c)),
                       "c[1]: got inf, expected a finite number", slant::bad_input);
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

}  // namespace affine_test
