// SPDX-License-Identifier: MIT
#include <slant/operators/counted.hpp>
#include <slant/slanting/slanting.hpp>
#include <slant/testing/archetypes.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>
#include "slanting_support.hpp"

namespace composition_test {

using slanting_support::dense_slant;
using slanting_support::random_matrix;
using slanting_support::random_vector;

TEST_CASE("the chain rule, with different sizes") {
  MatrixXd const a = random_matrix(2, 3, 1);
  VectorXd const c = random_vector(2, 2);
  auto const squares = slant::smooth(
      2, 2, [](auto const& y, auto& f) { f = y.cwiseAbs2(); },
      [](auto const& y) { return MatrixXd((2 * y).asDiagonal()); });
  auto const f = slant::compose(squares, slant::affine(a, c));
  CHECK(f.rows() == 2);
  CHECK(f.cols() == 3);
  VectorXd const y = random_vector(3, 3);
  VectorXd const inner = a * y + c;
  CHECK((slant::evaluate(f, y) - inner.cwiseAbs2()).norm() <= 1e-15);
  MatrixXd const expected = (2 * inner).asDiagonal() * a;
  CHECK((dense_slant(f, y) - expected).norm() <= 1e-15);
  slant::testing::check_slanting_laws(f, y, test::zeros(3));
}

TEST_CASE("a slant after a value evaluates nothing again, at any depth; nothing allocates") {
  MatrixXd const m = random_matrix(4, 4, 1);
  auto const a = slant::counted(m);
  auto const b = slant::counted(m);
  auto const inner = slant::compose(slant::positive_part(4), slant::affine(a, random_vector(4, 2)));
  auto const f = slant::compose(slant::positive_part(4), slant::compose(slant::linear(b), inner));
  VectorXd const y = random_vector(4, 3);
  VectorXd v(4);
  auto w = slant::workspace(f, y);
  auto g = f.slant(y);
  auto const applications = [&] {
    auto const n = a.counts().applications * 100 + b.counts().applications;
    a.reset_counts();
    b.reset_counts();
    return n;
  };
  applications();
  slant::evaluate(f, y, v, w);
  CHECK(applications() == 101);  // each once
  slant::update_slant_after_value(f, y, g, w);
  CHECK(applications() == 0);
  slant::update_slant(f, y, g, w);
  CHECK(applications() == 101);
  slanting_support::check_renewal(f, y);
}

TEST_CASE("parts of which nothing is known but the concept") {
  namespace archetype = slant::testing::archetype;
  archetype::slanting_function const f(2);
  auto const g = slant::compose(f, f);
  VectorXd const y{{1.0, -2.0}};
  CHECK(slant::evaluate(g, archetype::vector(y)).local() == VectorXd{{2.25, 1.5}});
  slant::testing::check_slanting_laws(g, archetype::vector(y),
                                      archetype::vector(VectorXd::Zero(2)));
}

TEST_CASE("bad input") {
  CHECK(SLANT_COMPLAINT(slant::compose(slant::positive_part(3), slant::positive_part(2))) ==
        "g.rows(): got 2, expected 3 (f.cols())");
}

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

TEST_CASE("bad input of stacks") {
  CHECK(SLANT_COMPLAINT(slant::stack(slant::positive_part(3), slant::positive_part(2))) ==
        "f2.cols(): got 2, expected 3 (f1.cols())");
}

}  // namespace composition_test
