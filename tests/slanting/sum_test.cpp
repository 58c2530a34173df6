// SPDX-License-Identifier: MIT
#include <slant/slanting/slanting.hpp>
#include <slant/testing/archetypes.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>
#include "slanting_support.hpp"

namespace sum_test {

using slanting_support::dense_slant;

TEST_CASE("values and slanting operators add") {
  MatrixXd const a = slanting_support::random_matrix(3, 3, 1);
  VectorXd const y{{1.0, -2.0, 0.0}};
  auto const f = slant::add(slant::affine(a, VectorXd::Ones(3)), slant::positive_part(3));
  VectorXd const expected = a * y + VectorXd{{2.0, 1.0, 1.0}};
  CHECK((slant::evaluate(f, y) - expected).norm() <= 1e-15);
  MatrixXd const slope = a + MatrixXd(Vector3d(1, 0, 1).asDiagonal());
  CHECK((dense_slant(f, y) - slope).norm() <= 1e-16);
  slant::testing::check_slanting_laws(f, y);
}

TEST_CASE("laws of the sum follow from those of the parts") {
  MatrixXd const m = slanting_support::random_spd(3, 1);
  auto const definite =
      slant::linear(slant::matrix<slant::self_adjoint, slant::positive_definite>(m));
  auto const any = slant::linear(slant::matrix(m));
  auto const projector = slant::positive_part(3);
  VectorXd const y = VectorXd::Zero(3);
  auto const g = slant::add(definite, projector);
  auto const h = slant::add(any, projector);
  static_assert(
      slant::spd_operator<slant::slant_operator_t<std::remove_cvref_t<decltype(g)>, VectorXd>,
                          VectorXd>);
  static_assert(!slant::declares_self_adjoint<
                slant::slant_operator_t<std::remove_cvref_t<decltype(h)>, VectorXd>>);
  CHECK(&g.term<0>() == &definite);  // referenced
}

TEST_CASE("parts of which nothing is known but the concept") {
  namespace archetype = slant::testing::archetype;
  archetype::slanting_function const f(2);
  auto const twice = slant::add(f, f);
  VectorXd const y{{1.0, -2.0}};
  CHECK(slant::evaluate(twice, archetype::vector(y)).local() == VectorXd{{3.0, 2.0}});
  slant::testing::check_slanting_laws(twice, archetype::vector(y));
}

TEST_CASE("value and renewal allocate nothing") {
  slanting_support::check_renewal(slant::add(slant::positive_part(50), slant::positive_part(50)),
                                  slanting_support::random_vector(50, 1));
}

TEST_CASE("bad input") {
  CHECK_THROWS_WITH_AS(
      static_cast<void>(slant::add(slant::positive_part(3), slant::positive_part(2))),
      "g.rows(): got 2, expected 3 (f.rows())", slant::bad_input);
}

}  // namespace sum_test
