// SPDX-License-Identifier: MIT
#include <slant/operators/matrix.hpp>
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

TEST_CASE("the slanting operator has the laws and the adjoint of A") {
  MatrixXd const m = slanting_support::random_spd(3, 1);
  auto const a = slant::matrix<slant::self_adjoint, slant::positive_definite>(m);
  auto const f = slant::affine(a, VectorXd::Ones(3));
  VectorXd const y = VectorXd::Zero(3);
  using slope = slant::slant_operator_t<decltype(f), VectorXd>;
  static_assert(slant::spd_operator<slope, VectorXd>);
  MatrixXd const b = random_matrix(2, 3, 7);
  auto const h = slant::linear(b);
  auto const g = h.slant(y);
  static_assert(slant::has_adjoint<std::remove_cvref_t<decltype(g)>, VectorXd>);
  VectorXd x(3);
  slant::apply_adjoint(g, VectorXd(VectorXd::Ones(2)), x);
  CHECK((x - b.transpose() * VectorXd::Ones(2)).norm() <= 1e-15);
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
  static_assert(slant::slanting_function<std::remove_cvref_t<decltype(f)>, archetype::vector>);
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

}  // namespace affine_test
